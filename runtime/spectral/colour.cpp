// The colours of tables, and the three numbers that stand for a spectrum in RGB mode.
#include <algorithm>

#include "spectral/cie.h"

namespace stokes {
namespace {

CellEnds in_double(const SpectrumTable& t) {
  CellEnds ends;
  std::copy(t.begin(), t.end(), ends.begin());
  return ends;
}

std::array<float, 3> floats(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }

// A colour outside the gamut could turn an albedo of 1 into more: keep within the values of the spectrum itself.
Vec3d within_values(Vec3d rgb, const SpectrumTable& t) {
  const auto [lowest, highest] = std::minmax_element(t.begin(), t.end());
  const double low = *lowest, high = *highest;
  return min(max(rgb, {low, low, low}), {high, high, high});
}

Vec3d exact_rgb(const Spectrum& s, SpectrumRole role) {
  Vec3d rgb = s.kind == SpectrumKind::Rgb ? s.rgb : Vec3d{s.value, s.value, s.value};
  if (s.kind == SpectrumKind::Rgb && (role == SpectrumRole::Reflectance || role == SpectrumRole::Emission)) rgb = max(rgb, {0, 0, 0});
  if (s.kind == SpectrumKind::Rgb && role == SpectrumRole::Reflectance) rgb = min(rgb, {1, 1, 1});
  return rgb * s.scale;
}

}  // namespace

Vec3d emission_xyz(const SpectrumTable& t) { return integrate_xyz(in_double(t)); }

Vec3d reflectance_xyz(const SpectrumTable& t) { return integrate_xyz(in_double(t), d65_cells()); }

std::array<float, 3> rgb_of(const Spectrum& s, SpectrumRole role) {
  if (s.kind == SpectrumKind::Number || s.kind == SpectrumKind::Rgb) return floats(exact_rgb(s, role));
  if (role == SpectrumRole::Index) {
    const double index = evaluate(s, role, 587.6);
    return floats({index, index, index});
  }
  const SpectrumTable table = tabulate(s, role);
  if (role == SpectrumRole::Emission) return floats(xyz_to_rgb(emission_xyz(table)));
  return floats(within_values(xyz_to_rgb(reflectance_xyz(table)), table));
}

}  // namespace stokes
