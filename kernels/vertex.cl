// A vertex: where a path scatters, at a surface or in a medium, with one interface for both. Knows the path it belongs to.
#ifndef STOKES_VERTEX_CL
#define STOKES_VERTEX_CL
#include "fluorescence.cl"
#include "shadow.cl"

typedef struct {
  Mask active;     // lanes that scatter here
  Mask in_medium;  // the rest of them is at a surface
  Mask glowing;    // in_medium, at a dye: light comes and goes in all directions alike, whatever the medium's phase function
  Real3 position;
  Real3 front;                    // surfaces: the geometric normal on wo's side
  Real3 axis, tangent, bitangent; // local frame: z is the shading normal on wo's side, or in media the direction of travel
  Real3 wo;                       // local
  Bsdf bsdf;
} Vertex;

/// The vertex of the lanes `in_medium` (at `end`) and `at_surface` (at `point`, material resolved).
STOKES_FN Vertex vertex_make(const SceneView* view, const PathState* path, const SurfacePoint* point, Int material, Real3 end, Mask in_medium,
                             Mask glowing, Mask at_surface) {
  Vertex v;
  v.active = in_medium | at_surface;
  v.in_medium = in_medium;
  v.glowing = glowing;
  const Mask outside = dot3(path->direction, point->ng) < real(0.0f);
  v.front = select3(outside, point->ng, neg3(point->ng));
  v.axis = select3(outside, point->ns, neg3(point->ns));
  v.position = point->position;
  if (SCENE_HAS_MEDIA) {
    v.axis = select3(in_medium, path->direction, v.axis);
    v.position = select3(in_medium, end, v.position);
  }
  make_frame(v.axis, &v.tangent, &v.bitangent);
  v.wo = to_local(v.axis, v.tangent, v.bitangent, neg3(path->direction));
  v.bsdf = bsdf_none();
  if (!SCENE_HAS_MEDIA || any(at_surface)) v.bsdf = bsdf_load(view, material, point, outside, &path->throughput.lambda, at_surface);
  return v;
}

/// Whether a world direction is on the same side of the surface as its local one is of the shading normal: else the
/// shading normal would let light through (or keep it back).
STOKES_FN Mask sides_agree(const Vertex* v, Real3 world, Real3 wi) {
  if (!SCENE_HAS_SMOOTH_NORMALS) return all_lanes();
  const Mask front = dot3(world, v->front) > real(0.0f), up = wi.z > real(0.0f);
  return (front & up) | (!front & !up);
}

/// The mean cosine of slot k's phase function at the vertex.
STOKES_FN Real vertex_g(const PathState* path, const Vertex* v, int k) {
  const Real g = medium_g(&path->medium, k);
  if (!SCENE_HAS_FLUORESCENT_MEDIA) return g;
  return v->glowing ? real(0.0f) : g;
}

/// Value and density of a medium's phase functions. In chromatic media each wavelength has its own: *pdf receives their mean, weighted by
/// the path's densities, which does not depend on which wavelength is the hero; a heuristic's weights must not either.
STOKES_FN Spectrum phase_eval(const PathState* path, const Vertex* v, Real cosine, Real* pdf) {
  if (!SCENE_HAS_CHROMATIC_MEDIA) {
    *pdf = phase_hg_pdf(vertex_g(path, v, 0), cosine);
    return spectrum_constant(*pdf);
  }
  Spectrum p;
  Real sum = real(0.0f), total = real(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    p.v[k] = phase_hg_eval(vertex_g(path, v, k), cosine);
    sum = fma(path->throughput.density.v[k], p.v[k], sum);
    total += path->throughput.density.v[k];
  }
  *pdf = sum / total;
  return p;
}

/// BSDF times |cosine|, or the phase function, towards the world direction wi; *pdf receives the density of vertex_sample.
STOKES_FN Spectrum vertex_eval(const SceneView* view, const PathState* path, const Vertex* v, Real3 wi, Real* pdf) {
  const Real3 lobe = to_local(v->axis, v->tangent, v->bitangent, wi);
  const Mask surface = v->active & !v->in_medium & sides_agree(v, wi, lobe);
  Spectrum f = bsdf_eval(view, &v->bsdf, &path->throughput.lambda, v->wo, lobe, surface, pdf);
  *pdf = surface ? *pdf : real(0.0f);
  if (SCENE_HAS_MEDIA && any(v->in_medium)) {
    Real phase_density;
    const Spectrum phase = phase_eval(path, v, lobe.z, &phase_density);
    *pdf = v->in_medium ? phase_density : *pdf;
    f = select_spectrum(v->in_medium, phase, f);
  }
  return f;
}

/// Samples a local direction. In chromatic media the slots' phase functions differ: *density_ratio receives p_k / p_hero.
STOKES_FN BsdfSample vertex_sample(const SceneView* view, const PathState* path, const Vertex* v, Real u1, Real u2, Real u3, Spectrum* density_ratio) {
  const Mask surface = v->active & !v->in_medium;
  BsdfSample s;
  s.weight = spectrum_constant(real(1.0f));
  s.wi = real3(real(0.0f), real(0.0f), real(1.0f));
  s.pdf = real(1.0f);
  if (any(surface)) s = bsdf_sample(view, &v->bsdf, &path->throughput.lambda, v->wo, u1, u2, u3, surface);
  if (SCENE_HAS_MEDIA && any(v->in_medium)) {
    Real g = SCENE_HAS_CHROMATIC_MEDIA ? hero_value(&path->throughput, &path->medium.g) : path->medium.g.v[0];
    if (SCENE_HAS_FLUORESCENT_MEDIA) g = v->glowing ? real(0.0f) : g;
    const Real3 wi = phase_hg_sample(g, u1, u2);
    Real pdf;
    const Spectrum phase = phase_eval(path, v, wi.z, &pdf);
    s.wi = select3(v->in_medium, wi, s.wi);
    s.pdf = v->in_medium ? pdf : s.pdf;
    const Real scale = SCENE_HAS_CHROMATIC_MEDIA ? real(1.0f) / phase_hg_eval(g, wi.z) : real(1.0f);
    FOR_EACH_WAVELENGTH(k) {
      const Real ratio = SCENE_HAS_CHROMATIC_MEDIA ? phase.v[k] * scale : real(1.0f);
      s.weight.v[k] = v->in_medium ? ratio : s.weight.v[k];
      density_ratio->v[k] = v->in_medium ? ratio : real(1.0f);
    }
  }
  return s;
}
#endif
