// Darts' fuzzy mirror: the mirror direction plus a point drawn uniformly inside a sphere of radius `roughness`; it counts as specular,
// so it has no value and no density. Local directions: +z is the normal on wo's side.
#ifndef STOKES_METAL_CL
#define STOKES_METAL_CL
#include "sampling.cl"

/// The sampled direction, whose weight is the albedo; what points below the surface is absorbed by the caller.
STOKES_FN Real3 metal_sample(Real roughness, Real3 wo, Real u1, Real u2, Real u3) {
  const Real3 mirror = real3(-wo.x, -wo.y, wo.z);
  if (!any(roughness > real(0.0f))) return mirror;
  const Real radius = roughness * pow_real(u3, real(1.0f / 3.0f));
  const Real3 fuzzy = normalize3(madd3(mirror, sample_uniform_sphere(u1, u2), radius));
  return select3(roughness > real(0.0f), fuzzy, mirror);
}
#endif
