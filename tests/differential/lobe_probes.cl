// Kernels that call the scattering lobes directly, LANES elements a work-item: eval with its density, and sample. Knows no scene.
#include "conductor.cl"
#include "dielectric.cl"
#include "lambertian.cl"
#include "layout.h"
#include "metal.cl"
#include "phase.cl"
#include "phong.cl"
#include "probe_lanes.cl"

// Lobes are called by their material's number; the phase function is one more.
#define LOBE_PHASE 100

/// Value (albedo 1) and density of a lobe.
STOKES_FN Real lobe_eval(int type, float parameter, float eta, float k, Real3 wo, Real3 wi, Real* pdf) {
  if (type == MATERIAL_CONDUCTOR) {
    Real cosine;
    const Real facets = conductor_eval(real(parameter), wo, wi, pdf, &cosine);
    return facets * fresnel_conductor(cosine, real(eta), real(k));
  }
  if (type == MATERIAL_DIELECTRIC) return rough_dielectric_eval(real(parameter), real(eta), wo, wi, pdf);
  if (type == MATERIAL_PHONG) {
    *pdf = phong_pdf(real(parameter), wo, wi);
    return phong_eval(real(parameter), wo, wi);
  }
  if (type == MATERIAL_BLINN_PHONG) {
    *pdf = blinn_phong_pdf(real(parameter), wo, wi);
    return blinn_phong_eval(real(parameter), wo, wi);
  }
  if (type == LOBE_PHASE) {
    *pdf = phase_hg_pdf(real(parameter), -dot3(wo, wi));
    return phase_hg_eval(real(parameter), -dot3(wo, wi));
  }
  *pdf = lambertian_pdf(wi);
  return lambertian_eval(wi);
}

__kernel void probe_lobe_eval(int type, float parameter, float eta, float k, const __global float* wos, const __global float* wis,
                              __global float* values, __global float* pdfs) {
  const Int i = elements();
  Real pdf;
  const Real value = lobe_eval(type, parameter, eta, k, gather_real3(wos, i * 3), gather_real3(wis, i * 3), &pdf);
  put(values, i, value);
  put(pdfs, i, pdf);
}

/// Five floats a sample: wi, weight, density. The phase function samples about wo = -z.
__kernel void probe_lobe_sample(int type, float parameter, float eta, float k, const __global float* wos, const __global float* us,
                                __global float* out) {
  const Int i = elements();
  const Real3 wo = gather_real3(wos, i * 3);
  const Real u1 = gather_real(us, i * 3), u2 = gather_real(us, i * 3 + 1), u3 = gather_real(us, i * 3 + 2);
  Real weight = real(1.0f), pdf = real(-1.0f), cosine;
  Real3 wi;
  if (type == MATERIAL_CONDUCTOR) {
    wi = conductor_sample(real(parameter), wo, u1, u2, &weight, &pdf, &cosine);
    weight = weight * fresnel_conductor(cosine, real(eta), real(k));
  } else if (type == MATERIAL_DIELECTRIC && parameter > 0.0f) {
    wi = rough_dielectric_sample(real(parameter), real(eta), wo, u1, u2, u3, &weight, &pdf);
  } else if (type == MATERIAL_DIELECTRIC) {
    wi = smooth_dielectric_sample(real(eta), wo, u3, &weight);
  } else if (type == MATERIAL_METAL) {
    wi = metal_sample(real(parameter), wo, u1, u2, u3);
  } else if (type == MATERIAL_PHONG) {
    wi = phong_sample(real(parameter), wo, u1, u2);
    pdf = phong_pdf(real(parameter), wo, wi);
  } else if (type == MATERIAL_BLINN_PHONG) {
    wi = blinn_phong_sample(real(parameter), wo, u1, u2);
    pdf = blinn_phong_pdf(real(parameter), wo, wi);
  } else if (type == LOBE_PHASE) {
    wi = phase_hg_sample(real(parameter), u1, u2);
    pdf = phase_hg_pdf(real(parameter), wi.z);
  } else {
    wi = lambertian_sample(u1, u2);
    pdf = lambertian_pdf(wi);
  }
  put(out, i * 5, wi.x), put(out, i * 5 + 1, wi.y), put(out, i * 5 + 2, wi.z);
  put(out, i * 5 + 3, weight), put(out, i * 5 + 4, pdf);
}

/// Reflectances: dielectric at index eta, conductor at eta + i k.
__kernel void probe_fresnel(const __global float* cosines, const __global float* etas, const __global float* ks, __global float* dielectric,
                            __global float* beyond, __global float* conductor) {
  const Int i = elements();
  Real cos_t;
  put(dielectric, i, fresnel_dielectric(gather_real(cosines, i), gather_real(etas, i), &cos_t));
  put(beyond, i, cos_t);
  put(conductor, i, fresnel_conductor(gather_real(cosines, i), gather_real(etas, i), gather_real(ks, i)));
}
