// The measured tables of data/, embedded at build time; data/README.md says where each comes from. Must not know of scenes.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "spectral/spectrum.h"

namespace stokes {

/// A CSV file as it stands on disk: named columns, rows of numbers. The first column is the wavelength in nm (or a row number).
struct DataTable {
  std::span<const char* const> columns;
  std::span<const double> values;  ///< row by row

  std::size_t rows() const { return values.size() / columns.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  /// The index of a column. Throws std::out_of_range when there is none of that name.
  std::size_t column(std::string_view name) const;
  /// Linear interpolation in the rows by the first column; held at the ends.
  double interpolate(double lambda, std::size_t column) const;
};

extern const DataTable kCie1931;       ///< xbar, ybar, zbar, 360-830 nm, 1 nm
extern const DataTable kIlluminantD65; ///< relative power, 300-780 nm, 5 nm
extern const DataTable kIlluminantA;   ///< likewise
extern const DataTable kIlluminantF11; ///< relative power, 380-780 nm, 5 nm
extern const DataTable kColorChecker;  ///< reflectance of the 24 patches, 380-730 nm, 10 nm
extern const DataTable kHemoglobin;    ///< molar extinction 1/(cm M) of HbO2 and Hb, 250-1000 nm, 2 nm
extern const DataTable kMonkSkinTones; ///< tone 1-10, sRGB code, linear sRGB, relative luminance

/// A column as a sampled spectrum, named after the column.
Spectrum table_spectrum(const DataTable& table, std::size_t column);

}  // namespace stokes
