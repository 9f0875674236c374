// Dielectric boundaries, smooth and GGX-rough, for radiance carried from the camera: refraction multiplies by (n_o / n_i)^2.
// `eta` is the index beyond the boundary over the index on wo's side. Local directions: +z is the normal on wo's side, so
// wi.z > 0 is a reflection and wi.z < 0 a refraction. The scatter albedo is the caller's.
#ifndef STOKES_DIELECTRIC_CL
#define STOKES_DIELECTRIC_CL
#include "fresnel.cl"
#include "microfacet.cl"

/// Smooth: reflects where u < F, else refracts; *weight receives the radiance scale. wo.z in (0, 1].
STOKES_FN Real3 smooth_dielectric_sample(Real eta, Real3 wo, Real u, Real* weight) {
  Real cos_t;
  const Real f = fresnel_dielectric(min_real(wo.z, real(1.0f)), eta, &cos_t);
  const Mask reflected = u < f;
  const Real inverse = real(1.0f) / eta;
  *weight = reflected ? real(1.0f) : inverse * inverse;
  const Real scale = reflected ? real(-1.0f) : -inverse;
  return real3(wo.x * scale, wo.y * scale, reflected ? wo.z : -cos_t);
}

/// Rough: BSDF times |cosine|; *pdf receives the density of rough_dielectric_sample. alpha > 0 (Walter et al. 2007).
STOKES_FN Real rough_dielectric_eval(Real alpha, Real eta, Real3 wo, Real3 wi, Real* pdf) {
  const Mask reflection = wi.z > real(0.0f);
  // The facet normal that takes wo to wi, on the side of +z.
  Real3 h = madd3(wo, wi, reflection ? real(1.0f) : eta);
  const Real length2 = dot3(h, h);
  const Real turn = copysign_real(real(1.0f), h.z) / sqrt_real(max_real(length2, real(1e-30f)));
  h = scale3(h, turn);
  const Real o_h = dot3(wo, h), i_h = dot3(wi, h);
  const Mask valid = (wo.z > real(0.0f)) & (wi.z != real(0.0f)) & (length2 > real(1e-20f)) & (o_h > real(0.0f)) &
                     (reflection ? i_h > real(0.0f) : i_h < real(0.0f));
  Real cos_t;
  const Real f = fresnel_dielectric(clamp_real(o_h, real(0.0f), real(1.0f)), eta, &cos_t);
  // Facets' density per unit solid angle of wi, before Fresnel and shadowing.
  const Real spread = sqr(i_h + o_h / eta);
  const Real jacobian = reflection ? real(0.25f) : o_h * abs_real(i_h) / max_real(spread, real(1e-30f));
  const Real facets = ggx_d(alpha, h) * jacobian / wo.z * (reflection ? f : real(1.0f) - f);
  const Real lambda_o = ggx_lambda(alpha, wo);
  const Real lambda_i = ggx_lambda(alpha, wi);
  const Real scale = reflection ? real(1.0f) : real(1.0f) / (eta * eta);
  *pdf = valid ? facets / (real(1.0f) + lambda_o) : real(0.0f);
  return valid ? scale * facets / (real(1.0f) + lambda_o + lambda_i) : real(0.0f);
}
STOKES_FN Real rough_dielectric_pdf(Real alpha, Real eta, Real3 wo, Real3 wi) {
  Real pdf;
  rough_dielectric_eval(alpha, eta, wo, wi, &pdf);
  return pdf;
}

/// Rough: picks a facet that wo sees, then reflects with its Fresnel probability (u3) or refracts; *weight receives value over density.
///
/// A tilted facet may reflect below the surface or refract above it. Such light is lost: other facets would explain its direction the
/// other way round, so evaluating it there would be wrong.
STOKES_FN Real3 rough_dielectric_sample(Real alpha, Real eta, Real3 wo, Real u1, Real u2, Real u3, Real* weight, Real* pdf) {
  const Real3 h = ggx_sample(alpha, wo, u1, u2);
  Real cos_t;
  const Real f = fresnel_dielectric(clamp_real(dot3(wo, h), real(0.0f), real(1.0f)), eta, &cos_t);
  const Mask reflects = u3 < f;
  const Real3 wi = select3(reflects, reflect3(wo, h), refract3(wo, h, eta, cos_t));
  const Real value = rough_dielectric_eval(alpha, eta, wo, wi, pdf);
  const Mask kept = (*pdf > real(0.0f)) & ((reflects & (wi.z > real(0.0f))) | (!reflects & (wi.z < real(0.0f))));
  *weight = kept ? value / *pdf : real(0.0f);
  return wi;
}
#endif
