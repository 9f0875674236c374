// Rays against the whole scene: the nearest hit, and whether anything is in the way. Quads, spheres and ellipsoids are tested for
// all lanes at once, triangles lane by lane through the BVH. Knows shapes, not materials.
//
// No scene-wide epsilon: a ray that starts on a primitive names it (`exclude`) and starts at offset_origin.
#ifndef STOKES_INTERSECT_CL
#define STOKES_INTERSECT_CL
#include "clearance.cl"
#include "rooms.cl"
#include "surface.cl"
#include "traverse.cl"

/// Adopts distance t (0: none) to primitive i where it is nearer.
STOKES_FN void keep_nearer(Hit* hit, Real t, int i) {
  const Mask nearer = (t > real(0.0f)) & (t < hit->t);
  hit->t = nearer ? t : hit->t;
  hit->primitive = nearer ? integer(i) : hit->primitive;
}

STOKES_FN void closest_triangles(const SceneView* view, Real3 o, Real3 d, Int exclude, Mask active, const Neighbourhood* near, Mask inside, Hit* hit) {
  const BvhSlabs slabs = prepare_slabs(o, d);
  const Mask meeting = active & meet_tree(view->bvh_nodes, &slabs, hit->t);
  if (!any(meeting)) return;
  BvhRays rays;
  prepare_rays(&slabs, o, d, &rays);
  float ts[LANES], us[LANES], vs[LANES];
  int excludes[LANES], primitives[LANES];
  store_real(hit->t, ts), store_real(hit->u, us), store_real(hit->v, vs);
  store_int(exclude, excludes), store_int(hit->primitive, primitives);
  int starts[LANES], seconds[LANES];
  store_int(inside ? near->first : integer(0), starts), store_int(inside ? near->second : integer(-1), seconds);
  const int first = first_triangle(view);
  for (uint lanes = lane_bits(meeting); lanes != 0u; lanes &= lanes - 1u) {
    const uint j = lowest_lane(lanes);
    TriangleHit found = {ts[j], 0.0f, 0.0f, STOKES_NONE};
    // A negative difference is no triangle's index, and an unused slot is never hit.
    traverse_closest(view->bvh_nodes, view->bvh_leaves, &rays, j, (uint)(excludes[j] - first), (uint)starts[j], (uint)seconds[j], &found);
    if (found.index == STOKES_NONE) continue;
    ts[j] = found.t;
    us[j] = found.b1;
    vs[j] = found.b2;
    primitives[j] = first + (int)found.index;
  }
  hit->t = load_real(ts);
  hit->u = load_real(us);
  hit->v = load_real(vs);
  hit->primitive = load_int(primitives);
}

STOKES_FN int is_loose(const SceneView* view, int quad) { return !((view->scene->room_quads[quad / 32] >> (quad % 32)) & 1u); }

/// closest_hit, with `between` as in meet_rooms, and for lanes whose rays stay `inside` what is known there.
STOKES_FN Hit closest_hit_of(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active, int between,
                             const Neighbourhood* near, Mask inside) {
  Hit hit;
  hit.t = tmax;
  hit.primitive = integer(-1);
  hit.u = real(0.0f);
  hit.v = real(0.0f);
  const int quads = first_sphere(view), spheres = first_ellipsoid(view), ellipsoids = first_triangle(view);
  if (SCENE_HAS_QUADS) {
    meet_rooms(view, o, d, tmax, exclude, active, between, &hit);
    for (int i = 0; i < quads; i++)
      if (is_loose(view, i)) keep_nearer(&hit, exclude == integer(i) ? real(0.0f) : meet_quad(view->quads + i, o, d), i);
  }
  if (SCENE_HAS_SPHERES)
    for (int i = quads; i < spheres; i++)
      keep_nearer(&hit, meet_sphere(view->spheres + (i - quads), o, d, hit.t, exclude == integer(i), active), i);
  if (SCENE_HAS_ELLIPSOIDS)
    for (int i = spheres; i < ellipsoids; i++)
      keep_nearer(&hit, meet_ellipsoid(view->ellipsoids + (i - spheres), o, d, hit.t, exclude == integer(i), active), i);
  hit.primitive = active ? hit.primitive : integer(-1);
  if (SCENE_HAS_TRIANGLES) closest_triangles(view, o, d, exclude, active, near, inside, &hit);
  return hit;
}

/// The nearest hit in (0, tmax). d is a unit vector. `exclude` is the primitive that the ray starts on, or -1: it is skipped
/// if flat, and met only at its far side if curved. Lanes that are not active get primitive -1.
STOKES_FN Hit closest_hit(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active) {
  const Neighbourhood none = nothing_known();
  return closest_hit_of(view, o, d, tmax, exclude, active, 0, &none, no_lanes());
}

/// The same, where the rays of the lanes `inside` end within what is known around them.
STOKES_FN Hit closest_hit_near(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active, const Neighbourhood* near, Mask inside) {
  return closest_hit_of(view, o, d, tmax, exclude, active, 0, near, inside);
}

/// The same, for rays most of which meet nothing.
STOKES_FN Hit first_obstacle(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active) {
  const Neighbourhood none = nothing_known();
  return closest_hit_of(view, o, d, tmax, exclude, active, 1, &none, no_lanes());
}

STOKES_FN Mask triangles_occlude(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active) {
  const BvhSlabs slabs = prepare_slabs(o, d);
  const Mask meeting = active & meet_tree(view->bvh_nodes, &slabs, tmax);
  if (!any(meeting)) return no_lanes();
  BvhRays rays;
  prepare_rays(&slabs, o, d, &rays);
  float ts[LANES];
  int excludes[LANES];
  store_real(tmax, ts), store_int(exclude, excludes);
  uint blocked = 0u;
  for (uint lanes = lane_bits(meeting); lanes != 0u; lanes &= lanes - 1u) {
    const uint j = lowest_lane(lanes);
    if (traverse_any(view->bvh_nodes, view->bvh_leaves, &rays, j, (uint)(excludes[j] - first_triangle(view)), ts[j]))
      blocked |= 1u << j;
  }
  return lane_mask(blocked);
}

/// True where anything but `exclude` (as in closest_hit) lies in (0, tmax). Interfaces count. False where not active.
STOKES_FN Mask occluded(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active) {
  const int quads = first_sphere(view), spheres = first_ellipsoid(view), ellipsoids = first_triangle(view);
  Mask open = active;
  if (SCENE_HAS_QUADS) {
    Hit wall;
    wall.t = tmax;
    wall.primitive = integer(-1);
    meet_rooms(view, o, d, tmax, exclude, active, 1, &wall);
    open = open & (wall.primitive < integer(0));
    for (int i = 0; i < quads; i++) {
      if (!is_loose(view, i)) continue;
      const Real t = meet_quad(view->quads + i, o, d);
      open = open & ((exclude == integer(i)) | !((t > real(0.0f)) & (t < tmax)));
    }
  }
  if (SCENE_HAS_SPHERES)
    for (int i = quads; i < spheres; i++) {
      const Real t = meet_sphere(view->spheres + (i - quads), o, d, tmax, exclude == integer(i), open);
      open = open & !((t > real(0.0f)) & (t < tmax));
    }
  if (SCENE_HAS_ELLIPSOIDS)
    for (int i = spheres; i < ellipsoids; i++) {
      const Real t = meet_ellipsoid(view->ellipsoids + (i - spheres), o, d, tmax, exclude == integer(i), open);
      open = open & !((t > real(0.0f)) & (t < tmax));
    }
  if (SCENE_HAS_TRIANGLES) open = open & !triangles_occlude(view, o, d, tmax, exclude, open);
  return active & !open;
}
#endif
