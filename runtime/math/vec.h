// Three-component vectors and affine transforms in double precision, for the host. Knows nothing of scenes or devices.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace stokes {

struct Vec3d {
  double x = 0, y = 0, z = 0;
  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
inline Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3d operator-(Vec3d a) { return {-a.x, -a.y, -a.z}; }
inline Vec3d operator*(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3d operator*(Vec3d a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3d operator*(double s, Vec3d a) { return a * s; }
inline Vec3d operator/(Vec3d a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline Vec3d& operator+=(Vec3d& a, Vec3d b) { return a = a + b; }
inline double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(Vec3d a, Vec3d b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length_squared(Vec3d a) { return dot(a, a); }
inline double length(Vec3d a) { return std::sqrt(dot(a, a)); }
inline Vec3d normalize(Vec3d a) { return a / length(a); }
inline Vec3d min(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
inline Vec3d max(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
inline bool is_finite(Vec3d a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// An affine map p -> M p + t, kept as a 3x4 matrix row by row.
struct Affine {
  std::array<double, 12> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

  Vec3d point(Vec3d p) const { return vector(p) + translation(); }
  Vec3d vector(Vec3d v) const {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z, m[8] * v.x + m[9] * v.y + m[10] * v.z};
  }
  /// Column i of the linear part (0, 1, 2).
  Vec3d column(int i) const { return {m[i], m[4 + i], m[8 + i]}; }
  Vec3d translation() const { return {m[3], m[7], m[11]}; }
  double determinant() const { return dot(column(0), cross(column(1), column(2))); }
  /// The map that undoes this one; the determinant must not be zero.
  Affine inverse() const;
  /// Transforms a normal (by the inverse transpose); not normalised.
  Vec3d normal(Vec3d n) const;
};
/// a after b: (a * b).point(p) == a.point(b.point(p)).
Affine operator*(const Affine& a, const Affine& b);

inline Affine operator*(const Affine& a, const Affine& b) {
  Affine r;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++) {
      double s = j == 3 ? a.m[4 * i + 3] : 0;
      for (int k = 0; k < 3; k++) s += a.m[4 * i + k] * b.m[4 * k + j];
      r.m[4 * i + j] = s;
    }
  return r;
}

inline Affine Affine::inverse() const {
  const Vec3d c0 = column(0), c1 = column(1), c2 = column(2);
  const double d = determinant();
  const Vec3d r0 = cross(c1, c2) / d, r1 = cross(c2, c0) / d, r2 = cross(c0, c1) / d;
  const Vec3d t = translation();
  return {{r0.x, r0.y, r0.z, -dot(r0, t), r1.x, r1.y, r1.z, -dot(r1, t), r2.x, r2.y, r2.z, -dot(r2, t)}};
}

inline Vec3d Affine::normal(Vec3d n) const {
  const Vec3d c0 = column(0), c1 = column(1), c2 = column(2);
  const double s = determinant() < 0 ? -1.0 : 1.0;
  return (cross(c1, c2) * n.x + cross(c2, c0) * n.y + cross(c0, c1) * n.z) * s;
}

}  // namespace stokes
