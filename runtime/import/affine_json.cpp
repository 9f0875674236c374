// Affine maps of the importers and how they are written as a transform of ours.
#include "import/affine_json.h"

#include <cmath>
#include <numbers>

namespace stokes {
namespace {

Affine from_columns(Vec3d x, Vec3d y, Vec3d z, Vec3d o) { return {{x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z}}; }

// Cosines of right angles come out as 6e-17; nobody wants to read that.
double rounded(double x) {
  const double nearest = std::round(x * 1e12) / 1e12;
  return nearest == 0 ? 0.0 : nearest;
}

}  // namespace

Affine translation_of(Vec3d t) { return from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t); }

Affine scaling_of(Vec3d s) { return from_columns({s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}); }

Affine rotation_of(double degrees, Vec3d a) {
  const double radians = degrees * std::numbers::pi / 180, c = std::cos(radians), s = std::sin(radians);
  const auto column = [&](Vec3d e) { return e * c + cross(a, e) * s + a * (dot(a, e) * (1 - c)); };
  return from_columns(column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1}), {});
}

Affine look_at_of(Vec3d origin, Vec3d target, Vec3d up) {
  const Vec3d z = normalize(target - origin), x = normalize(cross(up, z));
  return from_columns(x, cross(z, x), z, origin);
}

bool matrix_of(const std::vector<double>& m, Affine& out) {
  if (m.size() != 16 || m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] == 0) return false;
  for (std::size_t i = 0; i < 12; i++) out.m[i] = m[i] / m[15];
  return true;
}

ImportJson transform_json(const Affine& a) {
  ImportJson m = ImportJson::array();
  bool identity = true;
  for (std::size_t i = 0; i < 12; i++) {
    const double value = rounded(a.m[i]);
    identity &= value == (i % 5 == 0 ? 1 : 0);
    m.push_back(value);
  }
  if (identity) return nullptr;
  for (const int value : {0, 0, 0, 1}) m.push_back(value);
  return {{"matrix", m}};
}

}  // namespace stokes
