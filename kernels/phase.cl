// Phase functions: how a medium scatters. Densities per unit solid angle that integrate to 1, so one function is value and density.
// Knows directions and the mean cosine g, not media.
#ifndef STOKES_PHASE_CL
#define STOKES_PHASE_CL
#include "sampling.cl"

/// Henyey-Greenstein: value, and density of phase_hg_sample, at `cosine` = dot(-wo, wi). g in (-1, 1); g = 0 is isotropic.
STOKES_FN Real phase_hg_eval(Real g, Real cosine) {
  const Real q = fma(g, fma(real(-2.0f), cosine, g), real(1.0f));
  return (real(1.0f) - g * g) * real(STOKES_INV_4PI) / (q * sqrt_real(q));
}

/// Samples a direction about +z, the direction of travel, with density phase_hg_eval(g, z).
///
/// The textbook inversion divides by g; with d = (x + g) / (1 + g x), x uniform in (-1, 1), the g cancels and one formula serves all.
STOKES_FN Real3 phase_hg_sample(Real g, Real u1, Real u2) {
  const Real x = fma(real(2.0f), u1, real(-1.0f));
  const Real d = (x + g) / fma(g, x, real(1.0f));
  const Real cosine = clamp_real(fma(real(0.5f) * g, fma(-d, d, real(1.0f)), d), real(-1.0f), real(1.0f));
  const Real sine = safe_sqrt(fma(-cosine, cosine, real(1.0f)));
  Real s, c;
  sincos_2pi(u2, &s, &c);
  return real3(sine * c, sine * s, cosine);
}
STOKES_FN Real phase_hg_pdf(Real g, Real cosine) { return phase_hg_eval(g, cosine); }
#endif
