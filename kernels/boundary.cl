// How paths pass surfaces into the medium beyond: the next ray's start, boundaries that only change the medium, the way out of the scene.
// Knows paths, not what scatters them.
#ifndef STOKES_BOUNDARY_CL
#define STOKES_BOUNDARY_CL
#include "path.cl"

/// Starts the next ray of the masked lanes at a surface point, in the medium of the side that `direction` leaves into.
STOKES_FN void leave_surface(const SceneView* view, PathState* path, const SurfacePoint* point, Real3 direction, Mask mask) {
  const Mask out = dot3(direction, point->ng) > real(0.0f);
  path->origin = select3(mask, offset_origin(point, direction), path->origin);
  path->exclude = mask ? point->primitive : path->exclude;
  medium_enter(view, out ? point->medium_outside : point->medium_inside, &path->throughput, mask, &path->medium);
}

/// Whether a ray starts beyond everything and heads away from it.
STOKES_FN Mask leaves_box(const SceneView* view, Real3 o, Real3 d) {
  const Vec3 low = view->scene->box_low, high = view->scene->box_high;
  return ((o.x >= real(high.x)) & (d.x > real(0.0f))) | ((o.x <= real(low.x)) & (d.x < real(0.0f))) | ((o.y >= real(high.y)) & (d.y > real(0.0f))) |
         ((o.y <= real(low.y)) & (d.y < real(0.0f))) | ((o.z >= real(high.z)) & (d.z > real(0.0f))) | ((o.z <= real(low.z)) & (d.z < real(0.0f)));
}

/// Boundaries between the camera and what its rays meet first, up to which they fly through nothing. A path that starts beyond them spares the lanes
/// that are on their way the wait; its random numbers go on as if it had flown there with them.
#define STOKES_APPROACHES 8
STOKES_FN void path_approach(const SceneView* view, PathState* path, Mask made, Counters* counters) {
  // The first hit's channels want to know the boundary.
  if (!SCENE_HAS_INTERFACES || FILM_TAKES_RGB) return;
  if (FILM_CHANNELS & (FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH)) return;
  Mask flying = made;
  for (int i = 0; i < STOKES_APPROACHES; i++) {
    flying = flying & (path->medium.index == integer(0));
    if (!any(flying)) return;
    const Hit hit = closest_hit(view, path->origin, path->direction, real(STOKES_FAR), path->exclude, flying);
    const Mask met = flying & (hit.primitive >= integer(0));
    if (!any(met)) return;
    const SurfacePoint point = surface_point(view, path->origin, path->direction, hit, met);
    flying = met & ((point.flags & (int)SURFACE_INTERFACE) != integer(0)) & (point.emission == integer(-1));
    if (!any(flying)) return;
    if (SCENE_HAS_MEDIA) path_random(path, flying);
    count_lanes(counters, COUNTER_RAYS, flying);
    path->alpha = flying ? real(1.0f) : path->alpha;
    path->unseen = path->unseen & !flying;
    leave_surface(view, path, &point, path->direction, flying);
  }
}
#endif
