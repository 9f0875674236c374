// Single shapes against rays, all lanes at once, and how primitives are counted. Knows neither the BVH nor surfaces.
#ifndef STOKES_SHAPES_CL
#define STOKES_SHAPES_CL
#include "math.cl"
#include "view.cl"

/// primitive is the global index (quads, spheres, ellipsoids, triangles) or -1. u and v are a triangle's weights of its second
/// and third vertex, otherwise undefined. t is in units of |d|.
typedef struct {
  Real t;
  Int primitive;
  Real u, v;
} Hit;

STOKES_FN int first_sphere(const SceneView* view) { return (int)view->scene->quad_count; }
STOKES_FN int first_ellipsoid(const SceneView* view) { return first_sphere(view) + (int)view->scene->sphere_count; }
STOKES_FN int first_triangle(const SceneView* view) { return first_ellipsoid(view) + (int)view->scene->ellipsoid_count; }

/// Distance to a quad, or 0. Worked out from the corner, so that the error scales with the ray, not with the place in the
/// world; the quad is grown by that error, so that quads that share an edge leave no gap.
STOKES_FN Real meet_quad(const __global Quad* quad, Real3 o, Real3 d) {
  const Vec3 n = quad->normal, du = quad->dual_u, dv = quad->dual_v, corner = quad->corner;
  const Real3 q = real3(o.x - corner.x, o.y - corner.y, o.z - corner.z);
  const Real height = fma(q.x, real(n.x), fma(q.y, real(n.y), q.z * n.z));
  const Real slope = fma(d.x, real(n.x), fma(d.y, real(n.y), d.z * n.z));
  const Real t = -height / slope;
  const Real3 p = madd3(q, d, t);
  const Real u = fma(p.x, real(du.x), fma(p.y, real(du.y), p.z * du.z));
  const Real v = fma(p.x, real(dv.x), fma(p.y, real(dv.y), p.z * dv.z));
  const Real reach_u = fma(t, real(quad->growth_u), real(quad->reach_u));
  const Real reach_v = fma(t, real(quad->growth_v), real(quad->reach_v));
  const Mask inside = (abs_real(u - 0.5f) <= reach_u) & (abs_real(v - 0.5f) <= reach_v) & (t > real(0.0f));
  return inside ? t : real(0.0f);
}

/// Distance along the unit direction d to a sphere round the origin, or 0.
///
/// The discriminant comes from the chord's distance to the centre, not from b^2 - c, and the smaller root from the larger
/// (Haines, Guenther and Akenine-Moeller 2019). A ray that starts on the sphere, offset to its inside, meets the far side at the
/// end of the chord, 2 b; offset to its outside it meets nothing.
///
/// The roots are left out where none of the lanes `asked` can have one in (0, tmax): they pass by, head away from outside, or end before.
STOKES_FN Real meet_centred_sphere(Real3 o, Real3 d, Real radius, Real tmax, Mask on_it, Mask asked) {
  const Real b = -dot3(o, d);
  const Real3 chord = madd3(o, d, b);
  const Real distance2 = dot3(chord, chord), from2 = dot3(o, o), reach = radius * real(1.00001f), reach2 = reach * reach;
  const Mask towards = (distance2 <= reach2) & ((b > real(0.0f)) | (from2 <= reach2)) & (b - reach < tmax * real(1.00001f));
  if (!any(asked & (on_it | towards))) return real(0.0f);
  const Real distance = sqrt_real(distance2);
  const Real discriminant = (radius - distance) * (radius + distance);
  const Real q = b + copysign_real(safe_sqrt(discriminant), b);
  const Real m = sqrt_real(from2);
  const Real c = (m - radius) * (m + radius);
  const Real other = c / q;
  const Real first = min_real(q, other), last = max_real(q, other);
  Real t = first > real(0.0f) ? first : last;
  const Real chord_end = b > real(0.0f) ? b + b : last;
  t = on_it ? (c < real(0.0f) ? chord_end : real(0.0f)) : t;
  const Mask met = (on_it | (discriminant >= real(0.0f))) & (t > real(0.0f));
  return met ? t : real(0.0f);
}

STOKES_FN Real meet_sphere(const __global Sphere* sphere, Real3 o, Real3 d, Real tmax, Mask on_it, Mask asked) {
  const Vec3 c = sphere->center;
  return meet_centred_sphere(real3(o.x - c.x, o.y - c.y, o.z - c.z), d, real(sphere->radius), tmax, on_it, asked);
}

/// Rows 0 to 2 of a 3x4 matrix times (p, w).
STOKES_FN Real3 transform3x4(const __global float* m, Real3 p, float w) {
  return real3(fma(p.x, real(m[0]), fma(p.y, real(m[1]), fma(p.z, real(m[2]), real(m[3] * w)))),
               fma(p.x, real(m[4]), fma(p.y, real(m[5]), fma(p.z, real(m[6]), real(m[7] * w)))),
               fma(p.x, real(m[8]), fma(p.y, real(m[9]), fma(p.z, real(m[10]), real(m[11] * w)))));
}

STOKES_FN Real meet_ellipsoid(const __global Ellipsoid* ellipsoid, Real3 o, Real3 d, Real tmax, Mask on_it, Mask asked) {
  const Real3 inner_d = transform3x4(ellipsoid->to_local, d, 0.0f);
  const Real length = sqrt_real(dot3(inner_d, inner_d)), inv_length = real(1.0f) / length;
  return meet_centred_sphere(transform3x4(ellipsoid->to_local, o, 1.0f), scale3(inner_d, inv_length), real(1.0f), tmax * length, on_it, asked) *
         inv_length;
}
#endif
