// The point of a hit: its position worked out anew on the primitive itself, normals, coordinates, what the surface is made of, and
// a bound of the position's error. Knows shapes and surfaces, not what happens there.
#ifndef STOKES_SURFACE_CL
#define STOKES_SURFACE_CL
#include "shapes.cl"

/// A point on a surface. ng is the unit geometric normal of the front side, ns the shading normal on the same side.
/// u, v: texture coordinates (only where SCENE_HAS_TEXTURES); b1, b2: a triangle's weights of its second and third vertex.
/// light, emission are -1 for none. error: how far along ng the true surface may be from `position`, rounding included.
/// Lanes without a hit hold finite nonsense.
typedef struct {
  Real3 position, ng, ns;
  Real u, v, b1, b2;
  Int primitive, surface, material, light, medium_outside, medium_inside, emission, flags;
  Real error;
} SurfacePoint;

// Bounds in units of the last place, u = 2^-24, counted as in Higham's gamma; each includes the rounding of the offset itself.
#define STOKES_ROUNDINGS_8 4.76837158203125e-7f
#define STOKES_ROUNDINGS_12 7.152557373046875e-7f

STOKES_FN Real3 abs3(Real3 a) { return real3(abs_real(a.x), abs_real(a.y), abs_real(a.z)); }

/// Index of the hit primitive within its own kind where m is true, else 0.
STOKES_FN Int own_index(Mask m, Int primitive, int first) { return m ? primitive - first : integer(0); }

STOKES_FN void quad_point(const SceneView* view, Real3 o, Real3 d, Real t, Int i, Mask m, SurfacePoint* point) {
  const __global float* words = (const __global float*)view->quads;
  const Int row = i * (int)(sizeof(Quad) / 16);
  Real plane[4];
  Int edge_u[4], edge_v[4];
  gather_real4(words, row, plane);
  gather_int4((const __global uint*)words, row + 4, edge_u);
  gather_int4((const __global uint*)words, row + 5, edge_v);
  const Real3 n = real3(plane[0], plane[1], plane[2]);
  const Real offset = plane[3];
  // The point is dropped onto the plane, which leaves the rounding of one dot product.
  Real3 p = madd3(o, d, t);
  p = madd3(p, n, offset - dot3(n, p));
  point->position = select3(m, p, point->position);
  point->ng = select3(m, n, point->ng);
  point->error = m ? (dot3(abs3(n), abs3(p)) + abs_real(offset)) * STOKES_ROUNDINGS_8 : point->error;
  point->surface = m ? edge_u[3] : point->surface;
  point->light = m ? edge_v[3] : point->light;
  if (SCENE_HAS_TEXTURES) {
    Real dual_u[4], dual_v[4];
    gather_real4(words, row + 1, dual_u);
    gather_real4(words, row + 2, dual_v);
    const Real u = dot3(real3(dual_u[0], dual_u[1], dual_u[2]), p) - dual_u[3];
    const Real v = dot3(real3(dual_v[0], dual_v[1], dual_v[2]), p) - dual_v[3];
    point->u = m ? clamp_real(u, real(0.0f), real(1.0f)) : point->u;
    point->v = m ? clamp_real(v, real(0.0f), real(1.0f)) : point->v;
  }
}

/// Longitude and latitude of a unit direction in the shape's frame, u and v in [0, 1], poles on the local z axis.
STOKES_FN void sphere_uv(Real3 direction, Mask m, SurfacePoint* point) {
  const Real u = fma(atan2_real(-direction.y, -direction.x), real(0.5f * STOKES_INV_PI), real(0.5f));
  const Real v = real(1.0f) - acos_real(direction.z) * STOKES_INV_PI;
  point->u = m ? u : point->u;
  point->v = m ? v : point->v;
}

STOKES_FN void sphere_point(const SceneView* view, Real3 o, Real3 d, Real t, Int i, Mask m, SurfacePoint* point) {
  const __global float* words = (const __global float*)view->spheres;
  const Int base = i * (int)(sizeof(Sphere) / 4);
  Real ball[4];
  Int ids[4];
  gather_real4(words, i * (int)(sizeof(Sphere) / 16), ball);
  gather_int4((const __global uint*)words, i * (int)(sizeof(Sphere) / 16) + 3, ids);
  const Real3 center = real3(ball[0], ball[1], ball[2]);
  const Real radius = ball[3];
  // Reprojected onto the sphere, along the radius.
  const Real3 outward = normalize3(madd3(sub3(o, center), d, t));
  const Real3 p = madd3(center, outward, radius);
  const Mask flip = ids[3] != integer(0);
  point->position = select3(m, p, point->position);
  point->ng = select3(m, select3(flip, neg3(outward), outward), point->ng);
  point->error = m ? (dot3(abs3(outward), abs3(center)) + radius) * STOKES_ROUNDINGS_8 : point->error;
  point->surface = m ? ids[1] : point->surface;
  point->light = m ? ids[2] : point->light;
  if (SCENE_HAS_TEXTURES) {
    const Real3 direction = real3(dot3(gather_real3(words, base + 4), outward), dot3(gather_real3(words, base + 7), outward),
                              dot3(gather_real3(words, base + 10), outward));
    sphere_uv(direction, m, point);
  }
}

STOKES_FN void ellipsoid_point(const SceneView* view, Real3 o, Real3 d, Real t, Int i, Mask m, SurfacePoint* point) {
  const __global float* words = (const __global float*)view->ellipsoids;
  const Int base = i * (int)(sizeof(Ellipsoid) / 4);
  Real l[12], w[12];
  for (int k = 0; k < 12; k++) {
    l[k] = gather_real(words, base + k);
    w[k] = gather_real(words, base + 12 + k);
  }
  const Real3 p = madd3(o, d, t);
  const Real3 q = normalize3(real3(fma(p.x, l[0], fma(p.y, l[1], fma(p.z, l[2], l[3]))),
                                   fma(p.x, l[4], fma(p.y, l[5], fma(p.z, l[6], l[7]))),
                                   fma(p.x, l[8], fma(p.y, l[9], fma(p.z, l[10], l[11])))));
  const Real3 on_it = real3(fma(q.x, w[0], fma(q.y, w[1], fma(q.z, w[2], w[3]))),
                            fma(q.x, w[4], fma(q.y, w[5], fma(q.z, w[6], w[7]))),
                            fma(q.x, w[8], fma(q.y, w[9], fma(q.z, w[10], w[11]))));
  // The gradient of |local|^2 points outwards, mirrored or not.
  const Real3 outward = normalize3(real3(fma(q.x, l[0], fma(q.y, l[4], q.z * l[8])), fma(q.x, l[1], fma(q.y, l[5], q.z * l[9])),
                                         fma(q.x, l[2], fma(q.y, l[6], q.z * l[10]))));
  const Real3 aq = abs3(q);
  const Real3 size = real3(fma(aq.x, abs_real(w[0]), fma(aq.y, abs_real(w[1]), fma(aq.z, abs_real(w[2]), abs_real(w[3])))),
                           fma(aq.x, abs_real(w[4]), fma(aq.y, abs_real(w[5]), fma(aq.z, abs_real(w[6]), abs_real(w[7])))),
                           fma(aq.x, abs_real(w[8]), fma(aq.y, abs_real(w[9]), fma(aq.z, abs_real(w[10]), abs_real(w[11])))));
  const Mask flip = gather_int((const __global uint*)words, base + 26) != integer(0);
  point->position = select3(m, on_it, point->position);
  point->ng = select3(m, select3(flip, neg3(outward), outward), point->ng);
  point->error = m ? dot3(abs3(outward), size) * STOKES_ROUNDINGS_12 : point->error;
  point->surface = m ? gather_int((const __global uint*)words, base + 24) : point->surface;
  point->light = m ? gather_int((const __global uint*)words, base + 25) : point->light;
  if (SCENE_HAS_TEXTURES) sphere_uv(q, m, point);
}

STOKES_FN Real3 weigh3(Real b0, Real b1, Real b2, Real3 p0, Real3 p1, Real3 p2) {
  return madd3(madd3(scale3(p0, b0), p2, b2), p1, b1);
}

STOKES_FN void triangle_point(const SceneView* view, const Hit* hit, Int i, Mask m, SurfacePoint* point) {
  const __global uint* words = (const __global uint*)view->triangles;
  const __global float* positions = (const __global float*)view->positions;
  const Int base = i * (int)(sizeof(Triangle) / 4);
  const Int v0 = gather_int(words, base), v1 = gather_int(words, base + 1), v2 = gather_int(words, base + 2);
  const Real3 p0 = gather_real3(positions, v0 * 3), p1 = gather_real3(positions, v1 * 3), p2 = gather_real3(positions, v2 * 3);
  const Real b1 = m ? hit->u : real(0.0f), b2 = m ? hit->v : real(0.0f), b0 = real(1.0f) - b1 - b2;
  const Real3 n = normalize3(cross3(sub3(p1, p0), sub3(p2, p0)));
  const Real3 size = weigh3(abs_real(b0), b1, b2, abs3(p0), abs3(p1), abs3(p2));
  point->position = select3(m, weigh3(b0, b1, b2, p0, p1, p2), point->position);
  point->ng = select3(m, n, point->ng);
  point->error = m ? dot3(abs3(n), size) * STOKES_ROUNDINGS_12 : point->error;
  point->b1 = b1;
  point->b2 = b2;
  point->surface = m ? gather_int(words, base + 3) : point->surface;
  point->light = m ? gather_int(words, base + 4) : point->light;
  if (SCENE_HAS_SMOOTH_NORMALS | SCENE_HAS_TEXTURES)
    point->flags = gather_int((const __global uint*)view->surfaces, point->surface * (int)(sizeof(Surface) / 4) + 4);
  if (SCENE_HAS_SMOOTH_NORMALS) {
    const Mask smooth = m & ((point->flags & (int)SURFACE_SMOOTH_NORMALS) != integer(0));
    const __global float* normals = (const __global float*)view->normals;
    if (any(smooth)) {
      const Int n0 = smooth ? v0 : integer(0), n1 = smooth ? v1 : integer(0), n2 = smooth ? v2 : integer(0);
      const Real3 sum = weigh3(b0, b1, b2, gather_real3(normals, n0 * 3), gather_real3(normals, n1 * 3), gather_real3(normals, n2 * 3));
      const Real length2 = dot3(sum, sum);
      const Real scale = copysign_real(real(1.0f) / sqrt_real(length2), dot3(sum, n));
      point->ns = select3(smooth & (length2 > real(1e-12f)), scale3(sum, scale), point->ns);
    }
  }
  if (SCENE_HAS_TEXTURES) {
    const Mask mapped = m & ((point->flags & (int)SURFACE_HAS_UV) != integer(0));
    point->u = m ? b1 : point->u;
    point->v = m ? b2 : point->v;
    if (any(mapped)) {
      Real s0, t0, s1, t1, s2, t2;
      gather_real2(view->uvs, mapped ? v0 : integer(0), &s0, &t0);
      gather_real2(view->uvs, mapped ? v1 : integer(0), &s1, &t1);
      gather_real2(view->uvs, mapped ? v2 : integer(0), &s2, &t2);
      point->u = mapped ? fma(b1, s1, fma(b2, s2, b0 * s0)) : point->u;
      point->v = mapped ? fma(b1, t1, fma(b2, t2, b0 * t0)) : point->v;
    }
  }
}

/// The surface that a primitive belongs to, in the lanes of m; 0 elsewhere.
STOKES_FN Int surface_of(const SceneView* view, Int primitive, Mask m) {
  const int spheres = first_sphere(view), ellipsoids = first_ellipsoid(view), triangles = first_triangle(view);
  Int surface = integer(0);
#define STOKES_SURFACE_CASE(present, first, end, records, type, word)                                                          \
  if (present) {                                                                                                               \
    const Mask is = m & (primitive >= integer(first)) & (primitive < integer(end));                                            \
    const Int at = own_index(is, primitive, first) * (int)(sizeof(type) / 4) + word;                                           \
    if (any(is)) surface = is ? gather_int((const __global uint*)view->records, at) : surface;                                 \
  }
  STOKES_SURFACE_CASE(SCENE_HAS_QUADS, 0, spheres, quads, Quad, 19)
  STOKES_SURFACE_CASE(SCENE_HAS_SPHERES, spheres, ellipsoids, spheres, Sphere, 13)
  STOKES_SURFACE_CASE(SCENE_HAS_ELLIPSOIDS, ellipsoids, triangles, ellipsoids, Ellipsoid, 24)
  STOKES_SURFACE_CASE(SCENE_HAS_TRIANGLES, triangles, 0x7fffffff, triangles, Triangle, 3)
#undef STOKES_SURFACE_CASE
  return surface;
}

/// What a hit of the ray (o, d) found, in the lanes of m that have a hit.
STOKES_FN SurfacePoint surface_point(const SceneView* view, Real3 o, Real3 d, Hit hit, Mask m) {
  const int spheres = first_sphere(view), ellipsoids = first_ellipsoid(view), triangles = first_triangle(view);
  SurfacePoint point;
  point.primitive = m ? hit.primitive : integer(-1);
  point.position = o;
  point.ng = real3(real(0.0f), real(0.0f), real(1.0f));
  point.ns = real3(real(0.0f), real(0.0f), real(0.0f));
  point.error = point.u = point.v = point.b1 = point.b2 = real(0.0f);
  point.surface = point.flags = integer(0);
  point.light = integer(-1);
  const Int i = point.primitive;
  if (SCENE_HAS_QUADS) {
    const Mask is = (i >= integer(0)) & (i < integer(spheres));
    if (any(is)) quad_point(view, o, d, hit.t, own_index(is, i, 0), is, &point);
  }
  if (SCENE_HAS_SPHERES) {
    const Mask is = (i >= integer(spheres)) & (i < integer(ellipsoids));
    if (any(is)) sphere_point(view, o, d, hit.t, own_index(is, i, spheres), is, &point);
  }
  if (SCENE_HAS_ELLIPSOIDS) {
    const Mask is = (i >= integer(ellipsoids)) & (i < integer(triangles));
    if (any(is)) ellipsoid_point(view, o, d, hit.t, own_index(is, i, ellipsoids), is, &point);
  }
  if (SCENE_HAS_TRIANGLES) {
    const Mask is = i >= integer(triangles);
    if (any(is)) triangle_point(view, &hit, own_index(is, i, triangles), is, &point);
  }
  const Mask flat = (point.ns.x == real(0.0f)) & (point.ns.y == real(0.0f)) & (point.ns.z == real(0.0f));
  point.ns = select3(flat, point.ng, point.ns);
  const __global uint* surfaces = (const __global uint*)view->surfaces;
  Int record[4];
  gather_int4(surfaces, point.surface * (int)(sizeof(Surface) / 16), record);
  point.material = record[0];
  point.medium_outside = record[1];
  point.medium_inside = record[2];
  point.emission = record[3];
  point.flags = gather_int(surfaces, point.surface * (int)(sizeof(Surface) / 4) + 4);
  return point;
}

/// Where a ray that leaves the point towards `direction` starts: on that side of the surface, beyond every rounding.
STOKES_FN Real3 offset_origin(const SurfacePoint* point, Real3 direction) {
  return madd3(point->position, point->ng, copysign_real(point->error, dot3(direction, point->ng)));
}
#endif
