// Phong and Blinn-Phong lobes as darts defines them: value (BSDF times cosine, for albedo 1) equals density above the surface.
// Local directions: +z is the normal on wo's side.
#ifndef STOKES_PHONG_CL
#define STOKES_PHONG_CL
#include "sampling.cl"

/// (n + 1) / (2 pi) cosine^n; 0 for a cosine that is not positive.
STOKES_FN Real power_lobe(Real exponent, Real cosine) {
  const Real value = (exponent + real(1.0f)) * real(0.5f * STOKES_INV_PI) * pow_real(cosine, exponent);
  return cosine > real(0.0f) ? value : real(0.0f);
}

/// About +z with density power_lobe(exponent, z).
STOKES_FN Real3 sample_power_lobe(Real exponent, Real u1, Real u2) {
  const Real z = pow_real(u1, real(1.0f) / (exponent + real(1.0f)));
  const Real r = safe_sqrt(fma(-z, z, real(1.0f)));
  Real s, c;
  sincos_2pi(u2, &s, &c);
  return real3(r * c, r * s, z);
}

/// The lobe about the mirror direction; its part below the surface is lost, so this is the density of phong_sample only above it.
STOKES_FN Real phong_pdf(Real exponent, Real3 wo, Real3 wi) {
  return power_lobe(exponent, dot3(real3(-wo.x, -wo.y, wo.z), wi));
}
STOKES_FN Real phong_eval(Real exponent, Real3 wo, Real3 wi) {
  return wi.z > real(0.0f) ? phong_pdf(exponent, wo, wi) : real(0.0f);
}
STOKES_FN Real3 phong_sample(Real exponent, Real3 wo, Real u1, Real u2) {
  const Real3 mirror = real3(-wo.x, -wo.y, wo.z);
  Real3 t, b;
  make_frame(mirror, &t, &b);
  return to_world(mirror, t, b, sample_power_lobe(exponent, u1, u2));
}

/// Half vectors follow the lobe about the normal; the density of wi is theirs over 4 |wo.h|.
STOKES_FN Real blinn_phong_pdf(Real exponent, Real3 wo, Real3 wi) {
  const Real3 sum = add3(wo, wi);
  const Real length2 = dot3(sum, sum);
  const Real3 h = scale3(sum, real(1.0f) / sqrt_real(max_real(length2, real(1e-30f))));
  const Real cosine = abs_real(dot3(wo, h));
  const Mask valid = (length2 > real(1e-12f)) & (cosine > real(0.0f));
  return valid ? power_lobe(exponent, h.z) / (real(4.0f) * max_real(cosine, real(1e-12f))) : real(0.0f);
}
STOKES_FN Real blinn_phong_eval(Real exponent, Real3 wo, Real3 wi) {
  return wi.z > real(0.0f) ? blinn_phong_pdf(exponent, wo, wi) : real(0.0f);
}
STOKES_FN Real3 blinn_phong_sample(Real exponent, Real3 wo, Real u1, Real u2) {
  const Real3 h = sample_power_lobe(exponent, u1, u2);
  return sub3(scale3(h, real(2.0f) * dot3(wo, h)), wo);
}
#endif
