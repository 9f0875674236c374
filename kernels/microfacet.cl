// The GGX distribution of microfacet normals (Walter et al. 2007), in local coordinates: +z is the normal on wo's side.
// Shadowing is Smith's, correlated in height: G = 1 / (1 + Lambda(wo) + Lambda(wi)).
#ifndef STOKES_MICROFACET_CL
#define STOKES_MICROFACET_CL
#include "sampling.cl"

/// Density of microfacet normals per unit solid angle and projected area.
STOKES_FN Real ggx_d(Real alpha, Real3 h) {
  const Real a2 = alpha * alpha;
  const Real q = fma(h.x, h.x, fma(h.y, h.y, a2 * h.z * h.z));
  return a2 * real(STOKES_INV_PI) / (q * q);
}

/// Smith's Lambda: 1 / (1 + Lambda(w)) is the part of the facets facing w that w sees. w.z must not be 0.
STOKES_FN Real ggx_lambda(Real alpha, Real3 w) {
  const Real tan2 = fma(w.x, w.x, w.y * w.y) / (w.z * w.z);
  return real(0.5f) * (sqrt_real(fma(alpha * alpha, tan2, real(1.0f))) - real(1.0f));
}

/// Samples a normal among those that wo sees (wo.z > 0), by spherical caps (Dupuy and Benyoub 2023).
STOKES_FN Real3 ggx_sample(Real alpha, Real3 wo, Real u1, Real u2) {
  const Real3 stretched = normalize3(real3(alpha * wo.x, alpha * wo.y, wo.z));
  Real s, c;
  sincos_2pi(u1, &s, &c);
  const Real z = fma(real(1.0f) - u2, real(1.0f) + stretched.z, -stretched.z);
  const Real sine = safe_sqrt(fma(-z, z, real(1.0f)));
  const Real3 h = add3(real3(sine * c, sine * s, z), stretched);
  return normalize3(real3(alpha * h.x, alpha * h.y, max_real(h.z, real(1e-9f))));
}

/// Density of ggx_sample per unit solid angle of h.
STOKES_FN Real ggx_pdf(Real alpha, Real3 wo, Real3 h) {
  const Real seen = max_real(dot3(wo, h), real(0.0f));
  return ggx_d(alpha, h) * seen / (wo.z * (real(1.0f) + ggx_lambda(alpha, wo)));
}
#endif
