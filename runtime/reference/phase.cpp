// Henyey & Greenstein 1941. See phase.h.
#include "reference/phase.h"

#include "reference/sampling.h"

namespace stokes::reference {

double phase_hg_eval(double g, double cosine) {
  const double base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
}

Vec3d phase_hg_sample(double g, Vec3d wo, double u1, double u2) {
  double cosine = 2 * u1 - 1;
  // The inversion of the cumulative distribution divides by g; near zero the isotropic limit and its first order term serve.
  if (std::abs(g) > 1e-5) {
    const double s = (1 - g * g) / (1 - g + 2 * g * u1);
    cosine = (1 + g * g - s * s) / (2 * g);
  } else {
    cosine += 1.5 * g * (1 - cosine * cosine);
  }
  return Frame(-wo).to_world(direction_at(std::clamp(cosine, -1.0, 1.0), u2));
}

}  // namespace stokes::reference
