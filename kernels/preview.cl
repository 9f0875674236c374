// The small integrators: shading normals as colours, and ambient occlusion. One path is one or two rays; nothing is scattered.
#ifndef STOKES_PREVIEW_CL
#define STOKES_PREVIEW_CL
#include "queue.cl"

/// 1 in lanes from whose point a cosine-distributed ray meets nothing.
STOKES_FN Real ambient_occlusion(const SceneView* view, PathState* path, const SurfacePoint* point, Mask hit, Counters* counters) {
  const Mask outside = dot3(path->direction, point->ng) < real(0.0f);
  const Real3 n = select3(outside, point->ns, neg3(point->ns)), front = select3(outside, point->ng, neg3(point->ng));
  Real3 t, b;
  make_frame(n, &t, &b);
  const Real u1 = path_random(path, hit), u2 = path_random(path, hit);
  const Real3 direction = to_world(n, t, b, sample_cosine_hemisphere(u1, u2));
  const Mask above = hit & (dot3(direction, front) > real(0.0f));
  count_lanes(counters, COUNTER_SHADOW_RAYS, above);
  const Mask blocked = occluded(view, offset_origin(point, direction), direction, real(STOKES_FAR), point->primitive, above);
  return (above & !blocked) ? real(1.0f) : real(0.0f);
}

/// Traces all paths of the queue. The samples are R, G and B as they stand, whatever the wavelengths.
STOKES_FN void trace_previews(const SceneView* view, const __global Launch* launch, PathQueue* queue, __global long* film, Counters* counters) {
  PathState path = path_none();
  for (;;) {
    refill(view, launch, queue, &path, film, counters);
    if (!any(path.alive)) return;
    count_lanes(counters, COUNTER_RAYS, path.alive);
    const Hit hit = closest_hit(view, path.origin, path.direction, real(STOKES_FAR), path.exclude, path.alive);
    const Mask found = path.alive & (hit.primitive >= integer(0));
    const SurfacePoint point = surface_point(view, path.origin, path.direction, hit, found);
    Real3 rgb = abs3(point.ns);
    if (INTEGRATOR == INTEGRATOR_AO) {
      const Real open = ambient_occlusion(view, &path, &point, found, counters);
      rgb = real3(open, open, open);
    }
    const Real3 black = real3(real(0.0f), real(0.0f), real(0.0f));
    path.rgb = select3(found, rgb, black);
    path.alpha = found ? real(1.0f) : real(0.0f);
    path.depth = found ? hit.t : real(0.0f);
    path.normal = select3(found, point.ns, black);
    path.albedo = select3(found, real3(real(1.0f), real(1.0f), real(1.0f)), black);
    path.alive = no_lanes();
  }
}
#endif
