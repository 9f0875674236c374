// Next-event estimation: the light that reaches a vertex straight from a light source. Knows vertices and lights, not the loop.
#ifndef STOKES_DIRECT_CL
#define STOKES_DIRECT_CL
#include "vertex.cl"

// Whether light is sought at vertices at all.
#define STOKES_SEEKS_LIGHT (INTEGRATOR == INTEGRATOR_NEE || INTEGRATOR == INTEGRATOR_MIS)

/// Where light is sought: not at specular surfaces, and not in media that light enters by refraction alone.
STOKES_FN Mask seeks_light(const SceneView* view, const PathState* path, const Vertex* v) {
  if (!STOKES_SEEKS_LIGHT || view->scene->light_count == 0u) return no_lanes();
  const Mask sealed = v->in_medium & ((path->medium.flags & (int)MEDIUM_SEALED) != integer(0));
  return v->active & !sealed & !v->bsdf.specular & !(bsdf_is(&v->bsdf, MATERIAL_BLACK));
}

/// Radiance of a sampled light towards the vertex, at the throughput's wavelengths. The light is known to be seen.
STOKES_FN Spectrum light_radiance(const SceneView* view, const LightSample* s, Real3 origin, Int exclude, const Throughput* t, Mask mask) {
  if (lone_lamp(view) >= 0) return t->lamp;
  const Spectrum* lambda = &t->lambda;
  const Int emission = gather_int((const __global uint*)view->lights, s->light * LIGHT_WORDS + 2);
  const Mask near = mask & (emission != integer(-1));
  Spectrum light = spectrum_constant(real(0.0f));
  if (SCENE_HAS_EMISSION_TEXTURES) {
    // The shadow ray was free, so what is met at the light's distance is the light: its point gives the texture's coordinates.
    const Mask textured = near & (emission < integer(0));
    SurfacePoint point;
    Hit hit = closest_hit(view, origin, s->direction, s->distance * 1.001f, exclude, textured);
    const Mask met = textured & (hit.primitive >= integer(0));
    point = surface_point(view, origin, s->direction, hit, met);
    light = color_eval(view, emission, &point, lambda, met | (near & !textured));
  } else {
    light = spectrum_eval(view, near ? emission : integer(0), lambda);
  }
  if (SCENE_HAS_ENVIRONMENT) {
    const Mask image = mask & !near;
    if (any(image)) light = select_spectrum(image, environment_radiance(view, s->direction, lambda), light);
  }
  return light;
}

/// Samples one light and adds what of it reaches the camera through this vertex. At a fluorescent vertex both branches are evaluated: the base
/// reflects at the path's wavelengths, the dyes are lit at the excitation wavelengths that the continued ray would use. `share` is what this
/// estimate counts for among those that might have found the vertex.
STOKES_FN void collect_direct(const SceneView* view, PathState* path, const Vertex* v, const SurfacePoint* point, const Excitation* x, Mask seeking,
                              const LightNumbers* u, Real share, Counters* counters) {
  const LightSample s = light_sample(view, v->position, u, seeking);
  Real pdf;
  Spectrum f = vertex_eval(view, path, v, s.direction, &pdf);
  const Mask useful = seeking & (s.pdf > real(0.0f)) & (pdf > real(0.0f));
  if (!any(useful)) return;

  // The shadow ray starts in the medium of the side that it leaves into.
  const Mask out = dot3(s.direction, point->ng) > real(0.0f);
  ShadowRay ray;
  ray.origin = select3(v->in_medium, v->position, offset_origin(point, s.direction));
  ray.direction = s.direction;
  ray.distance = s.distance;
  ray.exclude = v->in_medium ? integer(-1) : point->primitive;
  ray.medium = v->in_medium ? path->medium.index : (out ? point->medium_outside : point->medium_inside);
  const Real3 origin = ray.origin;
  const Int exclude = ray.exclude;
  Spectrum depth = spectrum_constant(real(0.0f)), excited_depth = depth;
  const Mask seen = shadow_walk(view, &ray, path, &x->throughput.lambda, useful, counters, &depth, &excited_depth);
  if (!any(seen)) return;

  // Directions are shared with the continued ray: the heuristic weighs solid angles, never transmittances.
  Real weight = (INTEGRATOR == INTEGRATOR_MIS ? power_heuristic(s.pdf, pdf) : real(1.0f)) / s.pdf;
  if (SCENE_HAS_THIN_MEDIA) weight = weight * share;
  Spectrum light = light_radiance(view, &s, origin, exclude, &path->throughput, seen);
  const Spectrum clarity = transmittance(&depth);
  FOR_EACH_WAVELENGTH(k) light.v[k] *= f.v[k] * clarity.v[k];
  path_collect(path, &light, weight, seen);

  if (STOKES_FLUORESCENCE && any(seen & x->lanes)) {
    Spectrum exciting = light_radiance(view, &s, origin, exclude, &x->throughput, seen & x->lanes);
    const Spectrum excited_clarity = transmittance(&excited_depth);
    FOR_EACH_WAVELENGTH(k) exciting.v[k] *= excited_clarity.v[k];
    // The dyes re-emit over the cosine lobe, whose value is its density.
    collect_light(&x->throughput, &exciting, weight * pdf, seen & x->lanes, &path->radiance);
    if (FILM_CHANNELS & FILM_FLUORESCENCE) collect_light(&x->throughput, &exciting, weight * pdf, seen & x->lanes, &path->fluorescence);
  }
}
#endif
