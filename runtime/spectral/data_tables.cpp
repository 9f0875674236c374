// Looking things up in the embedded tables. The tables themselves are generated from data/ by embed_tables.cmake.
#include "spectral/data_tables.h"

#include <algorithm>
#include <stdexcept>

namespace stokes {

std::size_t DataTable::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::out_of_range("no column named " + std::string(name));
  return found - columns.begin();
}

double DataTable::interpolate(double lambda, std::size_t column) const {
  const std::size_t last = rows() - 1;
  if (lambda <= at(0, 0)) return at(0, column);
  if (lambda >= at(last, 0)) return at(last, column);
  // The tables are regular, so the row is known; the end rows were dealt with above.
  const double step = (at(last, 0) - at(0, 0)) / double(last);
  const std::size_t row = std::min<std::size_t>((lambda - at(0, 0)) / step, last - 1);
  const double f = (lambda - at(row, 0)) / step;
  return at(row, column) + f * (at(row + 1, column) - at(row, column));
}

Spectrum table_spectrum(const DataTable& table, std::size_t column) {
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  s.name = table.columns[column];
  for (std::size_t i = 0; i < table.rows(); i++) {
    s.wavelengths.push_back(table.at(i, 0));
    s.values.push_back(table.at(i, column));
  }
  return s;
}

}  // namespace stokes
