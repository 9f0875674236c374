// Frames and the elementary distributions of directions and points. Pure functions of uniform numbers; knows nothing of scenes.
#pragma once
#include <numbers>

#include "math/vec.h"

namespace stokes::reference {

inline constexpr double kPi = std::numbers::pi;

inline double square(double x) { return x * x; }
/// sqrt of the positive part.
inline double safe_sqrt(double x) { return x > 0 ? std::sqrt(x) : 0; }

/// A right-handed orthonormal frame about a unit vector n.
struct Frame {
  Vec3d t, b, n;
  explicit Frame(Vec3d normal) : n(normal) {
    const Vec3d axis = std::abs(n.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    t = normalize(cross(axis, n));
    b = cross(n, t);
  }
  Vec3d to_world(Vec3d v) const { return t * v.x + b * v.y + n * v.z; }
  Vec3d to_local(Vec3d v) const { return {dot(v, t), dot(v, b), dot(v, n)}; }
};

/// The unit vector with this cosine to +z, at the azimuth 2 pi u.
inline Vec3d direction_at(double cosine, double u) {
  const double sine = safe_sqrt(1 - cosine * cosine), phi = 2 * kPi * u;
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Density cos / pi about +z.
inline Vec3d sample_cosine_hemisphere(double u1, double u2) { return direction_at(std::sqrt(1 - u1), u2); }
/// Density (n + 1) / (2 pi) cos^n about +z.
inline Vec3d sample_cosine_power(double n, double u1, double u2) { return direction_at(std::pow(1 - u1, 1 / (n + 1)), u2); }
/// Density 1 / (4 pi).
inline Vec3d sample_uniform_sphere(double u1, double u2) { return direction_at(1 - 2 * u1, u2); }
/// Density 1 / (2 pi (1 - cosine_max)) about +z; takes 1 - cosine_max, which keeps its digits for narrow cones.
inline Vec3d sample_cone(double one_minus_cosine_max, double u1, double u2) { return direction_at(1 - u1 * one_minus_cosine_max, u2); }
/// A point in the unit disk (z = 0), uniform in area.
inline Vec3d sample_disk(double u1, double u2) {
  const double r = std::sqrt(u1), phi = 2 * kPi * u2;
  return {r * std::cos(phi), r * std::sin(phi), 0};
}
/// A point in the unit ball, uniform in volume.
inline Vec3d sample_ball(double u1, double u2, double u3) { return std::cbrt(u3) * sample_uniform_sphere(u1, u2); }

/// Veach's power heuristic with exponent 2; 1 where the other density is 0.
inline double power_heuristic(double pdf, double other) {
  if (other <= 0) return 1;
  const double ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace stokes::reference
