// Fresnel's equations for unpolarised light, in double. Knows nothing of materials.
#pragma once
#include "math/vec.h"

namespace stokes::reference {

/// Reflectance of a smooth dielectric at the cosine of incidence in [0, 1]; `eta` is the index beyond over the index before. 1 at total
/// internal reflection. `cosine_beyond`, when given, receives the refracted ray's cosine (0 at total reflection).
inline double fresnel_dielectric(double cosine, double eta, double* cosine_beyond = nullptr) {
  const double sine2_beyond = (1 - cosine * cosine) / (eta * eta);
  const double beyond = sine2_beyond < 1 ? std::sqrt(1 - sine2_beyond) : 0;
  if (cosine_beyond) *cosine_beyond = beyond;
  if (sine2_beyond >= 1) return 1;
  const double parallel = (eta * cosine - beyond) / (eta * cosine + beyond);
  const double perpendicular = (cosine - eta * beyond) / (cosine + eta * beyond);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// Reflectance of a conductor of complex index eta + i k (Born & Wolf 14.2).
inline double fresnel_conductor(double cosine, double eta, double k) {
  const double c2 = cosine * cosine, s2 = 1 - c2;
  const double t0 = eta * eta - k * k - s2;
  const double a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
  const double a = std::sqrt(std::max(0.0, 0.5 * (a2_plus_b2 + t0)));
  const double perpendicular = (a2_plus_b2 + c2 - 2 * a * cosine) / (a2_plus_b2 + c2 + 2 * a * cosine);
  const double parallel =
      perpendicular * (c2 * a2_plus_b2 + s2 * s2 - 2 * a * cosine * s2) / (c2 * a2_plus_b2 + s2 * s2 + 2 * a * cosine * s2);
  return 0.5 * (parallel + perpendicular);
}

}  // namespace stokes::reference
