// The Lambertian lobe, which fluorescent surfaces share. Local directions: +z is the normal on wo's side.
#ifndef STOKES_LAMBERTIAN_CL
#define STOKES_LAMBERTIAN_CL
#include "sampling.cl"

/// BSDF times cosine for albedo 1, and the density of lambertian_sample.
STOKES_FN Real lambertian_eval(Real3 wi) { return max_real(wi.z, real(0.0f)) * real(STOKES_INV_PI); }
STOKES_FN Real3 lambertian_sample(Real u1, Real u2) { return sample_cosine_hemisphere(u1, u2); }
STOKES_FN Real lambertian_pdf(Real3 wi) { return lambertian_eval(wi); }
#endif
