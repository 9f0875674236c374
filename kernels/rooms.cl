// Rooms: quads that are faces of boxes along the axes, met all at once. Knows rays and boxes, not what the walls are made of.
#ifndef STOKES_ROOMS_CL
#define STOKES_ROOMS_CL
#include "shapes.cl"

/// 1 / x, finite for all finite x.
STOKES_FN Real slope_inverse(Real x) { return real(1.0f) / copysign_real(max_real(abs_real(x), real(1e-30f)), x); }

/// Where a ray passes the two planes across one axis.
typedef struct {
  Real near, far;
  Int near_face, far_face;
} RoomSlab;

STOKES_FN RoomSlab room_slab(float low, float high, int low_face, int high_face, Real o, Real inverse) {
  const Real to_low = (real(low) - o) * inverse, to_high = (real(high) - o) * inverse;
  const Mask forward = inverse > real(0.0f);
  RoomSlab s;
  s.near = forward ? to_low : to_high;
  s.far = forward ? to_high : to_low;
  s.near_face = forward ? integer(low_face) : integer(high_face);
  s.far_face = forward ? integer(high_face) : integer(low_face);
  return s;
}

/// What two pairs of planes leave of a ray.
STOKES_FN RoomSlab slab_meet(RoomSlab a, RoomSlab b) {
  const Mask later = a.near > b.near, sooner = a.far < b.far;
  RoomSlab s;
  s.near = later ? a.near : b.near;
  s.near_face = later ? a.near_face : b.near_face;
  s.far = sooner ? a.far : b.far;
  s.far_face = sooner ? a.far_face : b.far_face;
  return s;
}

/// Adopts the wall that the ray meets from outside, or else the one that it meets from within, where it is nearer. `exclude` is skipped.
STOKES_FN void meet_room(const __global Room* room, Real3 o, Real3 inverse, Int exclude, Hit* hit) {
  const RoomSlab x = room_slab(room->low.x, room->high.x, room->faces[0], room->faces[1], o.x, inverse.x);
  const RoomSlab y = room_slab(room->low.y, room->high.y, room->faces[2], room->faces[3], o.y, inverse.y);
  const RoomSlab z = room_slab(room->low.z, room->high.z, room->faces[4], room->faces[5], o.z, inverse.z);
  const RoomSlab s = slab_meet(slab_meet(x, y), z);
  const Mask enters = (s.near > real(0.0f)) & (s.near_face >= integer(0)) & (s.near_face != exclude);
  const Real t = enters ? s.near : s.far;
  const Int face = enters ? s.near_face : s.far_face;
  const Mask nearer = (s.near <= s.far) & (t > real(0.0f)) & (t < hit->t) & (face >= integer(0)) & (face != exclude);
  hit->t = nearer ? t : hit->t;
  hit->primitive = nearer ? face : hit->primitive;
}

STOKES_FN Mask within_room(const __global Room* room, Real3 p) {
  return (p.x >= real(room->low.x)) & (p.x <= real(room->high.x)) & (p.y >= real(room->low.y)) & (p.y <= real(room->high.y)) &
         (p.z >= real(room->low.z)) & (p.z <= real(room->high.z));
}

/// Adopts the nearest wall of all rooms. With `between`, rays are asked for what stands between o and o + d tmax; that is no wall of a room which
/// holds both, so rooms are left out that hold all the active lanes' segments.
STOKES_FN void meet_rooms(const SceneView* view, Real3 o, Real3 d, Real tmax, Int exclude, Mask active, int between, Hit* hit) {
  const int count = (int)view->scene->room_count;
  if (count == 0) return;
  const Real3 inverse = real3(slope_inverse(d.x), slope_inverse(d.y), slope_inverse(d.z));
  const Real3 end = madd3(o, d, tmax);
  for (int i = 0; i < count; i++) {
    const __global Room* room = view->scene->rooms + i;
    if (between && !any(active & !(within_room(room, o) & within_room(room, end)))) continue;
    meet_room(room, o, inverse, exclude, hit);
  }
}
#endif
