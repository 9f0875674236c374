// The GGX conductor without its Fresnel factor, which is a spectrum and the caller's: *cosine receives the angle's cosine at the
// facet to compute it from. alpha = 0 is a mirror. Local directions: +z is the normal on wo's side.
#ifndef STOKES_CONDUCTOR_CL
#define STOKES_CONDUCTOR_CL
#include "fresnel.cl"
#include "microfacet.cl"

/// BSDF times cosine for a Fresnel factor of 1, alpha > 0; *pdf receives the density of conductor_sample.
STOKES_FN Real conductor_eval(Real alpha, Real3 wo, Real3 wi, Real* pdf, Real* cosine) {
  const Mask above = (wo.z > real(0.0f)) & (wi.z > real(0.0f));
  const Real3 sum = add3(wo, wi);
  const Real3 h = scale3(sum, real(1.0f) / sqrt_real(max_real(dot3(sum, sum), real(1e-30f))));
  const Real lambda_o = ggx_lambda(alpha, wo), lambda_i = ggx_lambda(alpha, wi);
  const Real facets = ggx_d(alpha, h) / (real(4.0f) * wo.z);
  *cosine = clamp_real(dot3(wo, h), real(0.0f), real(1.0f));
  *pdf = above ? facets / (real(1.0f) + lambda_o) : real(0.0f);
  return above ? facets / (real(1.0f) + lambda_o + lambda_i) : real(0.0f);
}
STOKES_FN Real conductor_pdf(Real alpha, Real3 wo, Real3 wi) {
  Real pdf, cosine;
  conductor_eval(alpha, wo, wi, &pdf, &cosine);
  return pdf;
}

/// Samples wi; *weight receives value over density without the Fresnel factor, 0 where wi is below the surface.
STOKES_FN Real3 conductor_sample(Real alpha, Real3 wo, Real u1, Real u2, Real* weight, Real* pdf, Real* cosine) {
  const Mask rough = alpha > real(0.0f);
  const Real a = rough ? alpha : real(1.0f);
  const Real3 h = select3(rough, ggx_sample(a, wo, u1, u2), real3(real(0.0f), real(0.0f), real(1.0f)));
  const Real3 wi = reflect3(wo, h);
  const Mask above = (wo.z > real(0.0f)) & (wi.z > real(0.0f));
  const Real lambda_o = ggx_lambda(a, wo), lambda_i = ggx_lambda(a, wi);
  const Real seen = rough ? (real(1.0f) + lambda_o) / (real(1.0f) + lambda_o + lambda_i) : real(1.0f);
  *weight = above ? seen : real(0.0f);
  *pdf = ggx_d(a, h) / (real(4.0f) * wo.z * (real(1.0f) + lambda_o));
  *cosine = clamp_real(dot3(wo, h), real(0.0f), real(1.0f));
  return wi;
}
#endif
