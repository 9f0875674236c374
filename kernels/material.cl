// From a surface point to the material that scatters there: blends are resolved to one component by chance, textures are read.
#ifndef STOKES_MATERIAL_CL
#define STOKES_MATERIAL_CL
#include "bsdf.cl"
#include "texture.cl"

#define MATERIAL_WORDS 12
#define STOKES_BLEND_DEPTH 8

/// Four words of a material, at row 0 (type, albedo, eta, k) or 1 (parameter, ...).
STOKES_FN void material_row(const SceneView* view, Int material, int row, Int* x4) {
  gather_int4((const __global uint*)view->materials, material * (MATERIAL_WORDS / 4) + row, x4);
}
STOKES_FN Int material_uint(const SceneView* view, Int material, int word) {
  return gather_int((const __global uint*)view->materials, material * MATERIAL_WORDS + word);
}
STOKES_FN Real material_float(const SceneView* view, Int material, int word) {
  return gather_real((const __global float*)view->materials, material * MATERIAL_WORDS + word);
}

/// The component of a blend (or of nested ones) that this path meets: child b with probability `amount`. wo is a world direction.
STOKES_FN Int material_resolve(const SceneView* view, const SurfacePoint* point, Real3 wo, Rng* rng, Mask mask) {
  Int material = mask ? point->material : integer(0);
  if (!SCENE_HAS_BLENDS) return material;
  Mask blend = mask & (material_uint(view, material, 0) == integer(MATERIAL_BLEND));
  if (!any(blend)) return material;
  Real u = random_next_where(rng, blend);
  for (int depth = 0; depth < STOKES_BLEND_DEPTH && any(blend); depth++) {
    const Int texture = material_uint(view, material, 7);
    const Mask textured = blend & (texture != integer(-1));
    Real amount = material_float(view, material, 8);
    if (any(textured)) {
      const Real value = scalar_eval(view, textured ? texture : integer(0), point, wo, textured);
      amount = textured ? clamp_real(value, real(0.0f), real(1.0f)) : amount;
    }
    // What is left of u is uniform again.
    const Mask second = u < amount;
    const Real rest = second ? u / amount : (u - amount) / (real(1.0f) - amount);
    const Int child = second ? material_uint(view, material, 6) : material_uint(view, material, 5);
    u = blend ? rest : u;
    material = blend ? child : material;
    blend = blend & (material_uint(view, material, 0) == integer(MATERIAL_BLEND));
  }
  return material;
}

/// The BSDF of a resolved material. `outside`: wo is on the side of the geometric normal.
STOKES_FN Bsdf bsdf_load(const SceneView* view, Int material, const SurfacePoint* point, Mask outside, const Spectrum* lambda, Mask mask) {
  Bsdf b;
  Int record[4];
  material_row(view, material, 0, record);
  b.type = mask ? record[0] : integer(-1);
  b.parameter = material_float(view, material, 4);
  b.specular = no_lanes();
  b.eta = real(1.5f);
  b.conductor_eta = b.conductor_k = integer(0);
  // Lights and interfaces have no albedo.
  b.color = color_eval(view, record[1], point, lambda, mask);
  if (SCENE_HAS_METAL) b.specular = b.specular | bsdf_is(&b, MATERIAL_METAL);
  if (SCENE_HAS_SMOOTH_DIELECTRIC || SCENE_HAS_ROUGH_DIELECTRIC) {
    const Mask dielectric = bsdf_is(&b, MATERIAL_DIELECTRIC);
    if (any(dielectric)) {
      // The hero's index decides the way; without dispersion all wavelengths share it.
      const Spectrum eta = spectrum_eval(view, dielectric ? record[2] : integer(0), lambda);
      b.eta = dielectric ? (outside ? eta.v[0] : real(1.0f) / eta.v[0]) : b.eta;
      b.specular = b.specular | (dielectric & !(b.parameter > real(0.0f)));
    }
  }
  if (SCENE_HAS_CONDUCTOR) {
    const Mask conductor = bsdf_is(&b, MATERIAL_CONDUCTOR);
    b.conductor_eta = conductor ? record[2] : integer(0);
    b.conductor_k = conductor ? record[3] : integer(0);
    b.specular = b.specular | (conductor & !(b.parameter > real(0.0f)));
  }
  return b;
}

/// Where the way through a dielectric depends on the wavelength.
STOKES_FN Mask material_is_dispersive(const SceneView* view, Int material, Mask mask) {
  if (!SCENE_HAS_DISPERSION) return no_lanes();
  return mask & ((material_uint(view, mask ? material : integer(0), 11) & (int)MATERIAL_DISPERSIVE) != integer(0));
}
#endif
