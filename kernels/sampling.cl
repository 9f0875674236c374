// Directions and points from uniform numbers, and local frames. Densities are stated with each sampler.
#ifndef STOKES_SAMPLING_CL
#define STOKES_SAMPLING_CL
#include "math.cl"

/// About +z with density cos / pi per unit solid angle.
STOKES_FN Real3 sample_cosine_hemisphere(Real u1, Real u2) {
  Real s, c;
  sincos_2pi(u2, &s, &c);
  const Real r = sqrt_real(u1);
  return real3(r * c, r * s, sqrt_real(real(1.0f) - u1));
}

/// Density 1 / (4 pi).
STOKES_FN Real3 sample_uniform_sphere(Real u1, Real u2) {
  Real s, c;
  sincos_2pi(u2, &s, &c);
  const Real z = fma(real(-2.0f), u1, real(1.0f));
  // 1 - z^2 = 4 u (1 - u), without cancellation at the poles.
  const Real r = real(2.0f) * sqrt_real(u1 * (real(1.0f) - u1));
  return real3(r * c, r * s, z);
}

/// Within the cone about +z whose opening is given as 1 - cos(half angle); density 1 / (2 pi one_minus_cos).
///
/// Small cones would cancel if their cosine were passed.
STOKES_FN Real3 sample_cone(Real u1, Real u2, Real one_minus_cos) {
  Real s, c;
  sincos_2pi(u2, &s, &c);
  const Real x = u1 * one_minus_cos;
  const Real r = safe_sqrt(x * (real(2.0f) - x));
  return real3(r * c, r * s, real(1.0f) - x);
}

/// Uniform on the unit disk.
STOKES_FN void sample_disk(Real u1, Real u2, Real* x, Real* y) {
  Real s, c;
  sincos_2pi(u2, &s, &c);
  const Real r = sqrt_real(u1);
  *x = r * c;
  *y = r * s;
}

/// Uniform barycentric weights of a triangle's second and third vertex.
STOKES_FN void sample_triangle(Real u1, Real u2, Real* b1, Real* b2) {
  const Real r = sqrt_real(u1);
  *b1 = r * (real(1.0f) - u2);
  *b2 = r * u2;
}

/// Completes the unit vector n to a right-handed frame (t, b, n) (Duff et al. 2017).
STOKES_FN void make_frame(Real3 n, Real3* t, Real3* b) {
  const Real sign = copysign_real(real(1.0f), n.z);
  const Real a = real(-1.0f) / (sign + n.z);
  const Real q = n.x * n.y * a;
  *t = real3(fma(sign * n.x * n.x, a, real(1.0f)), sign * q, -sign * n.x);
  *b = real3(q, fma(n.y * n.y, a, sign), -n.y);
}
STOKES_FN Real3 to_world(Real3 n, Real3 t, Real3 b, Real3 v) {
  return madd3(madd3(scale3(t, v.x), b, v.y), n, v.z);
}
STOKES_FN Real3 to_local(Real3 n, Real3 t, Real3 b, Real3 v) { return real3(dot3(v, t), dot3(v, b), dot3(v, n)); }
#endif
