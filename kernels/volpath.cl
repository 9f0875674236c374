// The path tracer: LANES paths fly, scatter and gather light in lockstep; an ended path makes room for the next. Surfaces and media
// share one loop. Knows the order of things; how each is done stands in the files it includes.
#ifndef STOKES_VOLPATH_CL
#define STOKES_VOLPATH_CL
#include "airlight.cl"
#include "aov.cl"
#include "queue.cl"

/// At fluorescent vertices: whether the continued ray takes the fluorescent branch, on whose wavelengths it then goes on.
STOKES_FN Mask choose_branch(const SceneView* view, PathState* path, const Excitation* x) {
  if (!any(x->lanes)) return no_lanes();
  const Mask fluoresces = x->lanes & (path_random(path, x->lanes) < x->probability);
  const Real reflects = real(1.0f) / (real(1.0f) - x->probability);
  throughput_scale(&path->throughput, reflects, x->lanes & !fluoresces);
  throughput_adopt(&path->throughput, &x->throughput, real(1.0f) / x->probability, fluoresces);
  path->fluoresced = path->fluoresced | fluoresces;
  if (SCENE_HAS_MEDIA && any(fluoresces)) medium_load(view, path->medium.index, &path->throughput, fluoresces, &path->medium);
  return fluoresces;
}

/// Draws the direction in which the path goes on from the vertex, and starts the next ray.
STOKES_FN void scatter(const SceneView* view, PathState* path, const Vertex* v, const SurfacePoint* point, const Excitation* x, Mask seeking) {
  const Mask fluoresces = STOKES_FLUORESCENCE ? choose_branch(view, path, x) : no_lanes();
  const Real u1 = path_random(path, v->active), u2 = path_random(path, v->active), u3 = path_random(path, v->active);
  Spectrum density_ratio = spectrum_constant(real(1.0f));
  const BsdfSample s = vertex_sample(view, path, v, u1, u2, u3, &density_ratio);
  Throughput* t = &path->throughput;
  // A fluorescent event's weight is already in the throughput: its lobe is drawn exactly.
  throughput_filter(t, &s.weight, v->active & !fluoresces);
  if (STOKES_HERO_DENSITIES) throughput_filter_density(t, &density_ratio, v->active);

  Real3 direction = to_world(v->axis, v->tangent, v->bitangent, s.wi);
  direction = scale3(direction, fma(real(-0.5f), dot3(direction, direction), real(1.5f)));
  const Mask lost = !(throughput_power(t) > real(0.0f)) | (!v->in_medium & !sides_agree(v, direction, s.wi));
  path->alive = path->alive & !(v->active & lost);
  path->direction = select3(v->active, direction, path->direction);
  path->vertex = select3(v->active, v->position, path->vertex);
  // Where light was not sought, what is hit counts in full.
  path->pdf = v->active ? (seeking ? s.pdf : real(-1.0f)) : path->pdf;
  if (SCENE_HAS_SMOOTH_DIELECTRIC || SCENE_HAS_ROUGH_DIELECTRIC) {
    const Mask refracted = v->active & bsdf_is(&v->bsdf, MATERIAL_DIELECTRIC) & (s.wi.z < real(0.0f));
    path->eta_scale = refracted ? path->eta_scale * v->bsdf.eta * v->bsdf.eta : path->eta_scale;
  }
  if (SCENE_HAS_MEDIA) {
    path->origin = select3(v->in_medium, v->position, path->origin);
    path->exclude = v->in_medium ? integer(-1) : path->exclude;
  }
  const Mask surface = v->active & !v->in_medium;
  if (any(surface)) leave_surface(view, path, point, direction, surface);
}

/// Ends paths that can bring little, by chance and without bias; power counts, over all wavelengths.
///
/// At surfaces one path in twenty ends whatever it carries, so that mirrors do not keep light for ever. In a medium it may live on: light
/// in skin scatters hundreds of times and loses little, and paths ended regardless would leave their weight to the few that come out.
STOKES_FN void russian_roulette(const SceneView* view, PathState* path, Mask scattered, Mask in_medium) {
  const uint begin = view->scene->russian_roulette;
  if (begin == STOKES_NONE) return;
  const Mask m = path->alive & scattered & (path->bounces >= integer((int)min(begin, 0x7fffffffu)));
  if (!any(m)) return;
  const Real most = in_medium ? real(1.0f) : real(0.95f);
  const Real survival = min_real(throughput_power(&path->throughput) * path->eta_scale, most);
  const Mask ends = m & (path_random(path, m) >= survival);
  path->alive = path->alive & !ends;
  throughput_scale(&path->throughput, real(1.0f) / survival, m & !ends);
}

/// Traces all paths of the queue.
STOKES_FN void trace_paths(const SceneView* view, const __global Launch* launch, PathQueue* queue, __global long* film, Counters* counters) {
  const Int max_bounces = integer((int)min(view->scene->max_bounces, 0x7fffffffu));
  PathState path = path_none();
  for (;;) {
    // Ended paths tell the film what they found; the next ones take their lanes.
    if (has_ended_paths(queue, &path)) {
      refill(view, launch, queue, &path, film, counters);
      if (!any(path.alive)) return;
    }
    if (LANES > 1) {
      count_lanes(counters, COUNTER_FLIGHTS, path.alive);
      counters->count[COUNTER_LANE_STEPS] += LANES;
    }

    // Fly until the medium scatters the path, a surface stops it, or it leaves the scene.
    const Real3 origin = path.origin;
    const Flight flight = path_fly(view, &path, counters);
    if (SCENE_HAS_THIN_MEDIA && any(flight.airlight.sought)) collect_airlight(view, &path, &flight.airlight, counters);

    // At a surface: take its light, and find the material that the path meets there.
    SurfacePoint point = surface_point_none();
    Int material = integer(0);
    Mask at_surface = flight.at_surface, escaped = flight.escaped;
    if (any(at_surface)) {
      point = surface_point(view, origin, path.direction, flight.hit, at_surface);
      collect_emission(view, &path, &point, at_surface);
      material = material_resolve(view, &point, neg3(path.direction), &path.rng, at_surface);
    }
    note_first_hit(view, &path, &flight, &point, origin, counters);
    if (any(at_surface)) {
      const Int type = material_uint(view, material, 0);
      // Index-matched boundaries only change the medium; lights absorb.
      const Mask crosses = at_surface & (type == integer(MATERIAL_INTERFACE));
      if (SCENE_HAS_INTERFACES && any(crosses)) {
        leave_surface(view, &path, &point, path.direction, crosses);
        escaped = escaped | (crosses & (path.medium.index == integer(0)) & leaves_box(view, path.origin, path.direction));
      }
      const Mask absorbs = at_surface & (type == integer(MATERIAL_BLACK));
      path.alive = path.alive & !absorbs;
      at_surface = at_surface & !crosses & !absorbs;
    }
    if (any(escaped)) {
      collect_surroundings(view, &path, escaped);
      path.alive = path.alive & !escaped;
    }

    // Whoever is left scatters, if it still may.
    Mask scatters = at_surface | flight.in_medium;
    const Mask spent = scatters & (path.bounces >= max_bounces);
    path.alive = path.alive & !spent;
    scatters = scatters & !spent;
    if (!any(scatters)) continue;
    path.bounces = scatters ? path.bounces + 1 : path.bounces;
    const Real3 end = madd3(origin, path.direction, flight.length);
    Vertex vertex = vertex_make(view, &path, &point, material, end, scatters & flight.in_medium, scatters & flight.glowing,
                                scatters & at_surface);
    const Mask dispersive = material_is_dispersive(view, material, scatters & bsdf_is(&vertex.bsdf, MATERIAL_DIELECTRIC));
    if (SCENE_HAS_DISPERSION && any(dispersive)) end_secondaries(&path.throughput, dispersive);
    Excitation excitation;
    if (STOKES_FLUORESCENCE) excitation = excitation_at(view, &path.throughput, material, &path.rng, scatters, &vertex.bsdf);

    // Light straight from a source, then on in a new direction.
    const Mask seeking = seeks_light(view, &path, &vertex);
    if (any(seeking)) {
      const LightNumbers numbers = light_numbers(&path, &flight.airlight, vertex.in_medium, seeking);
      collect_direct(view, &path, &vertex, &point, &excitation, seeking, &numbers, flight.airlight.share, counters);
    }
    scatter(view, &path, &vertex, &point, &excitation, seeking);
    russian_roulette(view, &path, scatters, vertex.in_medium);
  }
}
#endif
