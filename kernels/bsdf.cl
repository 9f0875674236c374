// Surface scattering of all materials behind one interface. Directions are local: +z is the shading normal on wo's side.
// The Lambertian lobe is everybody's fast path; the others are computed only where a lane needs them.
#ifndef STOKES_BSDF_CL
#define STOKES_BSDF_CL
#include "conductor.cl"
#include "dielectric.cl"
#include "lambertian.cl"
#include "metal.cl"
#include "phong.cl"
#include "spectrum.cl"

/// A material at a hit, blends resolved.
typedef struct {
  Int type;         // enum MaterialType; -1 in lanes that are not at a surface
  Mask specular;    // no value to evaluate: light is found by sampling alone
  Real parameter;   // alpha, roughness or exponent
  Real eta;         // dielectric: index beyond the boundary over the index on wo's side, for the hero
  Int conductor_eta, conductor_k;  // spectrum tables
  Spectrum color;   // albedo, scatter albedo; for fluorescence what is left of the base
} Bsdf;

/// What lanes have that are not at a surface.
STOKES_FN Bsdf bsdf_none(void) {
  Bsdf b;
  b.type = integer(-1);
  b.specular = no_lanes();
  b.parameter = b.eta = real(1.0f);
  b.conductor_eta = b.conductor_k = integer(0);
  b.color = spectrum_constant(real(0.0f));
  return b;
}

/// A sampled direction.
typedef struct {
  Real3 wi;         // local
  Spectrum weight;  // BSDF times |cosine| over the density
  Real pdf;         // per unit solid angle; -1: specular
} BsdfSample;

STOKES_FN Mask bsdf_is(const Bsdf* b, int type) { return b->type == integer(type); }

/// Lambertian, also under dyes.
STOKES_FN Mask bsdf_is_diffuse(const Bsdf* b) {
  Mask m = bsdf_is(b, MATERIAL_LAMBERTIAN);
  if (SCENE_HAS_FLUORESCENT_SURFACES) m = m | bsdf_is(b, MATERIAL_FLUORESCENT);
  if (SCENE_HAS_RERADIATION) m = m | bsdf_is(b, MATERIAL_RERADIATION);
  return m;
}

/// Multiplies the masked lanes' spectrum by a conductor's reflectance at the given cosine.
STOKES_FN void conductor_tint(const SceneView* view, const Bsdf* b, const Spectrum* lambda, Real cosine, Mask m, Spectrum* s) {
  const Spectrum eta = spectrum_eval(view, m ? b->conductor_eta : integer(0), lambda);
  const Spectrum k = spectrum_eval(view, m ? b->conductor_k : integer(0), lambda);
  FOR_EACH_WAVELENGTH(i) s->v[i] = m ? s->v[i] * fresnel_conductor(cosine, eta.v[i], k.v[i]) : s->v[i];
}

/// BSDF times |cosine| of the masked lanes, 0 for specular ones; *pdf receives the density of bsdf_sample.
STOKES_FN Spectrum bsdf_eval(const SceneView* view, const Bsdf* b, const Spectrum* lambda, Real3 wo, Real3 wi, Mask mask, Real* pdf) {
  Real value = lambertian_eval(wi);
  *pdf = value;
  Spectrum f;
  FOR_EACH_WAVELENGTH(k) f.v[k] = b->color.v[k];
  if (SCENE_HAS_PHONG) {
    const Mask phong = mask & bsdf_is(b, MATERIAL_PHONG), blinn = mask & bsdf_is(b, MATERIAL_BLINN_PHONG);
    if (any(phong | blinn)) {
      const Real lobe = phong ? phong_eval(b->parameter, wo, wi) : blinn_phong_eval(b->parameter, wo, wi);
      value = (phong | blinn) ? lobe : value;
      *pdf = (phong | blinn) ? lobe : *pdf;
    }
  }
  if (SCENE_HAS_CONDUCTOR) {
    const Mask m = mask & bsdf_is(b, MATERIAL_CONDUCTOR) & !b->specular;
    if (any(m)) {
      Real conductor_density, cosine;
      const Real conductor = conductor_eval(m ? b->parameter : real(1.0f), wo, wi, &conductor_density, &cosine);
      value = m ? conductor : value;
      *pdf = m ? conductor_density : *pdf;
      conductor_tint(view, b, lambda, cosine, m, &f);
    }
  }
  if (SCENE_HAS_ROUGH_DIELECTRIC) {
    const Mask m = mask & bsdf_is(b, MATERIAL_DIELECTRIC) & !b->specular;
    if (any(m)) {
      Real dielectric_density;
      const Real dielectric = rough_dielectric_eval(m ? b->parameter : real(1.0f), m ? b->eta : real(1.5f), wo, wi, &dielectric_density);
      value = m ? dielectric : value;
      *pdf = m ? dielectric_density : *pdf;
    }
  }
  value = (mask & !b->specular) ? value : real(0.0f);
  FOR_EACH_WAVELENGTH(k) f.v[k] = f.v[k] * value;
  return f;
}

/// Takes over the masked lanes of a sampled direction whose weight is `weight` times the colour.
STOKES_FN void adopt_sample(BsdfSample* s, Mask m, Real3 wi, Real weight, Real pdf) {
  s->wi = select3(m, wi, s->wi);
  s->pdf = m ? pdf : s->pdf;
  FOR_EACH_WAVELENGTH(k) s->weight.v[k] = m ? s->weight.v[k] * weight : s->weight.v[k];
}

STOKES_FN void sample_phong_lobes(const Bsdf* b, Real3 wo, Real u1, Real u2, Mask mask, BsdfSample* s) {
  const Mask phong = mask & bsdf_is(b, MATERIAL_PHONG), blinn = mask & bsdf_is(b, MATERIAL_BLINN_PHONG);
  if (any(phong)) {
    const Real3 wi = phong_sample(b->parameter, wo, u1, u2);
    adopt_sample(s, phong, wi, real(1.0f), phong_pdf(b->parameter, wo, wi));
  }
  if (any(blinn)) {
    const Real3 wi = blinn_phong_sample(b->parameter, wo, u1, u2);
    adopt_sample(s, blinn, wi, real(1.0f), blinn_phong_pdf(b->parameter, wo, wi));
  }
}

STOKES_FN void sample_rough_dielectric(const Bsdf* b, Real3 wo, Real u1, Real u2, Real u3, Mask m, BsdfSample* s) {
  const Real alpha = m ? b->parameter : real(1.0f), eta = m ? b->eta : real(1.5f);
  Real weight, pdf;
  const Real3 wi = rough_dielectric_sample(alpha, eta, wo, u1, u2, u3, &weight, &pdf);
  adopt_sample(s, m, wi, weight, pdf);
}

/// Samples wi in the masked lanes. A weight of 0 ends the path; a reflection below or a refraction above the surface counts as such.
STOKES_FN BsdfSample bsdf_sample(const SceneView* view, const Bsdf* b, const Spectrum* lambda, Real3 wo, Real u1, Real u2, Real u3, Mask mask) {
  BsdfSample s;
  s.wi = lambertian_sample(u1, u2);
  s.pdf = lambertian_pdf(s.wi);
  s.weight = b->color;
  if (SCENE_HAS_METAL) {
    const Mask m = mask & bsdf_is(b, MATERIAL_METAL);
    if (any(m)) adopt_sample(&s, m, metal_sample(b->parameter, wo, u1, u2, u3), real(1.0f), real(-1.0f));
  }
  if (SCENE_HAS_SMOOTH_DIELECTRIC) {
    const Mask m = mask & bsdf_is(b, MATERIAL_DIELECTRIC) & b->specular;
    if (any(m)) {
      Real weight;
      const Real3 wi = smooth_dielectric_sample(m ? b->eta : real(1.5f), wo, u3, &weight);
      adopt_sample(&s, m, wi, weight, real(-1.0f));
    }
  }
  if (SCENE_HAS_PHONG) sample_phong_lobes(b, wo, u1, u2, mask, &s);
  if (SCENE_HAS_CONDUCTOR) {
    const Mask m = mask & bsdf_is(b, MATERIAL_CONDUCTOR);
    if (any(m)) {
      Real weight, pdf, cosine;
      const Real3 wi = conductor_sample(b->parameter, wo, u1, u2, &weight, &pdf, &cosine);
      adopt_sample(&s, m, wi, weight, b->specular ? real(-1.0f) : pdf);
      conductor_tint(view, b, lambda, cosine, m, &s.weight);
    }
  }
  if (SCENE_HAS_ROUGH_DIELECTRIC) {
    const Mask m = mask & bsdf_is(b, MATERIAL_DIELECTRIC) & !b->specular;
    if (any(m)) sample_rough_dielectric(b, wo, u1, u2, u3, m, &s);
  }
  // Only dielectrics let light through.
  const Mask through = bsdf_is(b, MATERIAL_DIELECTRIC);
  const Mask lost = (s.wi.z == real(0.0f)) | (!through & (s.wi.z < real(0.0f)));
  FOR_EACH_WAVELENGTH(k) s.weight.v[k] = lost ? real(0.0f) : s.weight.v[k];
  return s;
}
#endif
