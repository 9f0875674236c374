// CIE 1931 colour matching, illuminants, XYZ and linear sRGB, and the sensor table made from them.
#include "spectral/cie.h"

#include <cmath>
#include <stdexcept>

#include "spectral/data_tables.h"

namespace stokes {
namespace {

// XYZ to linear sRGB (Rec. 709 primaries, white 0.3127, 0.3290), to full precision.
constexpr double kToRgb[3][3] = {{3.2409699419, -1.5373831776, -0.4986107603},
                                 {-0.9692436363, 1.8759675015, 0.0415550574},
                                 {0.0556300797, -0.2039769589, 1.0569715142}};

double ybar_sum() {
  double sum = 0;
  for (std::size_t i = 0; i < kCie1931.rows(); i++) sum += kCie1931.at(i, 2);
  return sum;
}

Vec3d solve(const Vec3d (&columns)[3], Vec3d right) {
  const Affine m{{columns[0].x, columns[1].x, columns[2].x, 0, columns[0].y, columns[1].y, columns[2].y, 0, columns[0].z, columns[1].z,
                  columns[2].z, 0}};
  return m.inverse().vector(right);
}

// The published sRGB matrix has its white at (0.3127, 0.3290), CIE's table of D65 at (0.31272, 0.32903): the table's pixel would be
// (1.00015, 0.99998, 0.99976). A factor quadratic in the wavelength (within 0.1 % of 1 from 380 nm, 0.2 % below) makes it (1, 1, 1), so that a white surface in
// white light is white to the last digit, and grey reflectances are upsampled to exact constants.
Vec3d white_correction() {
  static const Vec3d correction = [] {
    Vec3d columns[3];
    for (int power = 0; power < 3; power++) {
      CellEnds ends;
      for (int i = 0; i < 2 * kSpectrumCells; i++) {
        const double t = double(i / 2 + i % 2) / kSpectrumCells;
        ends[i] = illuminant_power("D65", 280 + i / 2 + i % 2, i % 2 == 1) * std::pow(t, power);
      }
      columns[power] = xyz_to_rgb(integrate_xyz(ends));
    }
    return solve(columns, {1, 1, 1});
  }();
  return correction;
}

double corrected_d65(double lambda, bool from_left) {
  const double t = (lambda - kLambdaMin) / (kLambdaMax - kLambdaMin);
  return illuminant_power("D65", lambda, from_left) * dot(white_correction(), {1, t, t * t});
}

double in_table(const DataTable& table, double lambda, bool from_left) {
  const double first = table.at(0, 0), last = table.at(table.rows() - 1, 0);
  const bool inside = from_left ? lambda > first && lambda <= last : lambda >= first && (lambda < last || last >= kLambdaMax);
  return inside ? table.interpolate(lambda, 1) : 0;
}

// CIE 15: illuminant A is a Planckian radiator at 2848 K with the old second radiation constant, 1.435e7 nm K, and 100 at 560 nm.
double illuminant_a(double lambda) {
  return 100 * std::pow(560 / lambda, 5) * std::expm1(1.435e7 / (2848 * 560.0)) / std::expm1(1.435e7 / (2848 * lambda));
}

}  // namespace

Vec3d cie_xyz(double lambda) {
  if (lambda < 360 || lambda > 830) return {};
  return {kCie1931.interpolate(lambda, 1), kCie1931.interpolate(lambda, 2), kCie1931.interpolate(lambda, 3)};
}

const CieCells& cie_cells() {
  static const CieCells cells = [] {
    CieCells c;
    const double scale = 1 / ybar_sum();
    for (int i = 0; i < 2 * kSpectrumCells; i++) {
      const int cell = i / 2;
      // The functions are 0 below 360 nm, and the step there lies between two cells.
      c.xyz[i] = 280 + cell < 360 ? Vec3d{} : cie_xyz(280 + cell + i % 2) * scale;
    }
    return c;
  }();
  return cells;
}

const CellEnds& d65_cells() {
  static const CellEnds cells = [] {
    CellEnds c;
    for (int i = 0; i < 2 * kSpectrumCells; i++) c[i] = corrected_d65(280 + i / 2 + i % 2, i % 2 == 1);
    return c;
  }();
  return cells;
}

// Simpson's rule is exact for the products of two and three linear functions.
Vec3d integrate_xyz(const CellEnds& radiance) {
  const auto& cie = cie_cells().xyz;
  Vec3d sum;
  for (int i = 0; i < 2 * kSpectrumCells; i += 2)
    sum += cie[i] * radiance[i] + (cie[i] + cie[i + 1]) * (radiance[i] + radiance[i + 1]) + cie[i + 1] * radiance[i + 1];
  return sum / 6;
}

Vec3d integrate_xyz(const CellEnds& reflectance, const CellEnds& light) {
  const auto& cie = cie_cells().xyz;
  Vec3d sum;
  for (int i = 0; i < 2 * kSpectrumCells; i += 2)
    sum += cie[i] * (reflectance[i] * light[i]) +
           (cie[i] + cie[i + 1]) * ((reflectance[i] + reflectance[i + 1]) * (light[i] + light[i + 1]) / 2) +
           cie[i + 1] * (reflectance[i + 1] * light[i + 1]);
  return sum / 6;
}

double illuminant_power(const std::string& name, double lambda, bool from_left) {
  if (name == "D65") return in_table(kIlluminantD65, lambda, from_left);
  if (name == "F11") return in_table(kIlluminantF11, lambda, from_left);
  if (name == "E") return 1;
  if (name == "A") return lambda < 300 ? illuminant_a(lambda) : kIlluminantA.interpolate(lambda, 1);
  throw std::domain_error("unknown illuminant " + name);
}

double d65(double lambda) { return corrected_d65(lambda, lambda >= kLambdaMax); }

Vec3d xyz_to_rgb(Vec3d xyz) {
  return {dot({kToRgb[0][0], kToRgb[0][1], kToRgb[0][2]}, xyz), dot({kToRgb[1][0], kToRgb[1][1], kToRgb[1][2]}, xyz),
          dot({kToRgb[2][0], kToRgb[2][1], kToRgb[2][2]}, xyz)};
}

Vec3d rgb_to_xyz(Vec3d rgb) {
  static constexpr Vec3d columns[3] = {{kToRgb[0][0], kToRgb[1][0], kToRgb[2][0]},
                                       {kToRgb[0][1], kToRgb[1][1], kToRgb[2][1]},
                                       {kToRgb[0][2], kToRgb[1][2], kToRgb[2][2]}};
  return solve(columns, rgb);
}

std::vector<float> sensor_table() {
  std::vector<float> table;
  table.reserve(8 * kSpectrumCells);
  for (const Vec3d& xyz : cie_cells().xyz) {
    const Vec3d rgb = xyz_to_rgb(xyz);
    for (const double v : {rgb.x, rgb.y, rgb.z, 0.0}) table.push_back(float(v));
  }
  return table;
}

}  // namespace stokes
