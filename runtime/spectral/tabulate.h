// From a spectrum's description to numbers: the value at a wavelength, the table of 1 nm cells, colours.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "spectral/spectrum.h"

namespace stokes {

inline constexpr double kLambdaMin = 280, kLambdaMax = 780;
inline constexpr int kSpectrumCells = 500;

/// 500 cells of 1 nm from 280 to 780 nm; cell c holds its values at 280 + c (element 2c) and 281 + c (element 2c + 1), and is
/// linear in between. Steps at whole nanometres are exact; a step or kink inside a cell keeps the cell's integral.
using SpectrumTable = std::array<float, 2 * kSpectrumCells>;

/// The value at `lambda` nm in [280, 780], from the right at a step.
double evaluate(const Spectrum& s, SpectrumRole role, double lambda);

/// The table of a spectrum. Throws std::domain_error naming the wavelength where a value is not finite.
SpectrumTable tabulate(const Spectrum& s, SpectrumRole role);

/// Linear interpolation inside the table's cells; lambda is clamped to [280, 780].
double table_value(const SpectrumTable& t, double lambda);
/// int over [a, b] of the table, nm times value.
double table_integral(const SpectrumTable& t, double a = kLambdaMin, double b = kLambdaMax);

/// True when every value of the table is equal to within `tolerance` relative.
bool is_constant(const SpectrumTable& t, double tolerance = 1e-6);

/// XYZ of an emission (int L xbar / int ybar); of a reflectance seen under D65 (white is D65's XYZ with Y = 1).
Vec3d emission_xyz(const SpectrumTable& t);
Vec3d reflectance_xyz(const SpectrumTable& t);
Vec3d xyz_to_rgb(Vec3d xyz);
Vec3d rgb_to_xyz(Vec3d rgb);

/// The three numbers that stand for a spectrum in RGB mode: the exact RGB of a number or [r,g,b] and of emissions seen directly;
/// a reflectance's or coefficient's colour under D65; an index of refraction's value at 587.6 nm in all three.
std::array<float, 3> rgb_of(const Spectrum& s, SpectrumRole role);

/// CIE 1931 2-degree colour matching functions (x, y, z) at `lambda`, 0 outside 360-830 nm; D65 normalised so that its Y is 1.
Vec3d cie_xyz(double lambda);
double d65(double lambda);
inline constexpr double kYbarIntegral = 106.8569;  ///< sum of ybar at 1 nm, 360-830 nm (use the table's own exact sum)

/// Jakob & Hanika 2019: coefficients c0, c1, c2 of the sigmoid of a quadratic in t = (lambda - 280) / 500, such that the reflectance
/// seen under D65 is `rgb` (components in [0, 1]; others are clamped). The round trip is within 1e-4.
std::array<float, 3> fit_sigmoid(Vec3d rgb);
/// The sigmoid's value; below 380 nm it holds its value at 380 nm.
double sigmoid_value(const std::array<float, 3>& c, double lambda);

/// sensor[c] for the 500 cells: linear sRGB weights (times 1/int ybar) at both ends, as r,g,b,0,r,g,b,0 (4000 floats).
std::vector<float> sensor_table();

/// The camera's inverse CDF: `segments` + 1 increasing wavelengths (see layout.h). The density follows the film's sensitivity,
/// and where `bins` > 0 half of it is uniform over [begin, end]; it is never zero where either is not.
std::vector<float> camera_knots(int segments, int bins, double begin, double end);

/// A table as a density: its integral and the cumulative table of 501 entries (0 ... 1). Negative values count as 0.
struct TableDistribution {
  double integral = 0;
  std::array<float, kSpectrumCells + 1> cdf{};
};
TableDistribution make_distribution(const SpectrumTable& t);
/// The wavelength at u in [0, 1): cell by the cumulative table, then exactly the linear density inside the cell.
double sample_distribution(const SpectrumTable& t, const TableDistribution& d, double u);

}  // namespace stokes
