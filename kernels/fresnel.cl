// Fresnel's equations for unpolarised light, and Snell's law. Local directions: +z is the normal on wo's side.
#ifndef STOKES_FRESNEL_CL
#define STOKES_FRESNEL_CL
#include "math.cl"

/// Reflectance of a dielectric boundary. `eta` is the index beyond the boundary over the index on wo's side; cos_o in [0, 1].
/// *cos_t receives the cosine of the refracted direction, 0 in total internal reflection.
STOKES_FN Real fresnel_dielectric(Real cos_o, Real eta, Real* cos_t) {
  const Real sin2_t = fma(-cos_o, cos_o, real(1.0f)) / (eta * eta);
  const Mask total = sin2_t >= real(1.0f);
  const Real c = safe_sqrt(real(1.0f) - sin2_t);
  const Real parallel = fma(eta, cos_o, -c) / fma(eta, cos_o, c);
  const Real perpendicular = fma(-eta, c, cos_o) / fma(eta, c, cos_o);
  *cos_t = total ? real(0.0f) : c;
  const Real f = real(0.5f) * fma(parallel, parallel, perpendicular * perpendicular);
  return total ? real(1.0f) : f;
}

/// Reflectance of a conductor of index eta + i k in vacuum; cos_o in [0, 1].
STOKES_FN Real fresnel_conductor(Real cos_o, Real eta, Real k) {
  const Real cos2 = cos_o * cos_o;
  const Real sin2 = real(1.0f) - cos2;
  const Real p = fma(eta, eta, fma(-k, k, -sin2));
  const Real a2_b2 = safe_sqrt(fma(p, p, real(4.0f) * sqr(eta * k)));
  const Real a = safe_sqrt(real(0.5f) * (a2_b2 + p));
  const Real s_sum = a2_b2 + cos2;
  const Real s_cross = real(2.0f) * a * cos_o;
  const Real s = (s_sum - s_cross) / (s_sum + s_cross);
  const Real p_sum = fma(a2_b2, cos2, sin2 * sin2);
  const Real p_cross = s_cross * sin2;
  return real(0.5f) * s * (real(1.0f) + (p_sum - p_cross) / (p_sum + p_cross));
}

/// The direction opposite to wo about the normal h.
STOKES_FN Real3 reflect3(Real3 wo, Real3 h) { return sub3(scale3(h, real(2.0f) * dot3(wo, h)), wo); }

/// The refracted direction, given cos_t from fresnel_dielectric; h points to wo's side.
STOKES_FN Real3 refract3(Real3 wo, Real3 h, Real eta, Real cos_t) {
  const Real inverse = real(1.0f) / eta;
  return madd3(scale3(wo, -inverse), h, fma(inverse, dot3(wo, h), -cos_t));
}
#endif
