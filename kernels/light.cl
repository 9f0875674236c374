// Lights: choosing one by power, sampling a direction towards it, and the density of that for a light that was hit by chance.
// Knows shapes and densities; radiance is looked up elsewhere.
#ifndef STOKES_LIGHT_CL
#define STOKES_LIGHT_CL
#include "environment.cl"
#include "sampling.cl"
#include "spectrum.cl"
#include "traverse.cl"

#define LIGHT_WORDS 8
#define QUAD_WORDS 28
#define SPHERE_WORDS 16
#define ELLIPSOID_WORDS 28
#define TRIANGLE_WORDS 8

/// A direction from a point towards a light.
typedef struct {
  Real3 direction;
  Real distance;  // STOKES_FAR for the surroundings
  Real pdf;       // per unit solid angle, with the probability of the light's choice; 0: no light there
  Int light;
} LightSample;

/// A point on a light and its front normal, chosen uniformly by area: turns it into a direction from p.
STOKES_FN void aim_at(Real3 p, Real3 target, Real3 normal, Real pdf_area, Mask mask, LightSample* s) {
  const Real3 to = sub3(target, p);
  const Real distance2 = dot3(to, to);
  const Real distance = sqrt_real(distance2);
  const Real3 direction = scale3(to, real(1.0f) / distance);
  const Real cosine = -dot3(direction, normal);
  const Mask lit = (cosine > real(0.0f)) & (distance2 > real(0.0f));
  s->direction = select3(mask, direction, s->direction);
  s->distance = mask ? distance : s->distance;
  s->pdf = mask ? (lit ? pdf_area * distance2 / cosine : real(0.0f)) : s->pdf;
}

/// Four words of a light's primitive, at row `row` of its record of `rows`. A scene's only light is read once for all lanes.
STOKES_FN void light_row(const SceneView* view, const __global float* records, Int primitive, int rows, int row, Real* x4) {
  if (view->scene->light_count == 1u) {
    const __global float* x = records + (view->lights[0].primitive * (uint)rows + (uint)row) * 4u;
    STOKES_UNROLL for (int k = 0; k < 4; k++) x4[k] = real(x[k]);
  } else {
    gather_real4(records, primitive * rows + row, x4);
  }
}

/// A uniform point on a quad.
STOKES_FN Real3 quad_light_point(const SceneView* view, Int quad, Real u1, Real u2, Real* area) {
  const __global float* quads = (const __global float*)view->quads;
  Real corner[4], edge_u[4], edge_v[4];
  light_row(view, quads, quad, QUAD_WORDS / 4, 3, corner);
  light_row(view, quads, quad, QUAD_WORDS / 4, 4, edge_u);
  light_row(view, quads, quad, QUAD_WORDS / 4, 5, edge_v);
  *area = corner[3];
  const Real3 start = madd3(real3(corner[0], corner[1], corner[2]), real3(edge_u[0], edge_u[1], edge_u[2]), u1);
  return madd3(start, real3(edge_v[0], edge_v[1], edge_v[2]), u2);
}

STOKES_FN void quad_light_sample(const SceneView* view, Int quad, Real3 p, Real u1, Real u2, Mask mask, LightSample* s) {
  Real plane[4], area;
  light_row(view, (const __global float*)view->quads, quad, QUAD_WORDS / 4, 0, plane);
  const Real3 target = quad_light_point(view, quad, u1, u2, &area);
  aim_at(p, target, real3(plane[0], plane[1], plane[2]), real(1.0f) / area, mask, s);
}

/// A uniform point on a triangle; *normal receives a vector along its front normal.
STOKES_FN Real3 triangle_light_point(const SceneView* view, Int triangle, Real u1, Real u2, Real3* normal) {
  const __global uint* triangles = (const __global uint*)view->triangles;
  const __global float* positions = (const __global float*)view->positions;
  const Int at = triangle * TRIANGLE_WORDS;
  const Real3 a = gather_real3(positions, gather_int(triangles, at) * 3);
  const Real3 edge_1 = sub3(gather_real3(positions, gather_int(triangles, at + 1) * 3), a);
  const Real3 edge_2 = sub3(gather_real3(positions, gather_int(triangles, at + 2) * 3), a);
  Real b1, b2;
  sample_triangle(u1, u2, &b1, &b2);
  *normal = cross3(edge_1, edge_2);
  return madd3(madd3(a, edge_1, b1), edge_2, b2);
}

STOKES_FN void triangle_light_sample(const SceneView* view, Int triangle, Real3 p, Real u1, Real u2, Mask mask, LightSample* s) {
  Real3 normal;
  const Real3 target = triangle_light_point(view, triangle, u1, u2, &normal);
  const Real area = gather_real((const __global float*)view->triangles, triangle * TRIANGLE_WORDS + 5);
  aim_at(p, target, normalize3(normal), real(1.0f) / area, mask, s);
}

/// 1 - cos of the half angle under which a sphere is seen, from the squares of its radius and of the distance to its centre.
STOKES_FN Real sphere_cone(Real radius2, Real distance2) {
  const Real sin2 = min_real(radius2 / distance2, real(1.0f));
  return sin2 / (real(1.0f) + safe_sqrt(real(1.0f) - sin2));
}

/// Whether a sphere light is sampled by its cone: seen from outside, where its front is.
STOKES_FN Mask sphere_by_cone(Real radius2, Real distance2, Mask flipped) { return (distance2 > real(1.0001f) * radius2) & !flipped; }

/// From outside by the cone that the sphere fills; from inside, and for flipped spheres, uniformly by area.
STOKES_FN void sphere_light_sample(const SceneView* view, Int sphere, Real3 p, Real u1, Real u2, Mask mask, LightSample* s) {
  const __global float* spheres = (const __global float*)view->spheres;
  Real record[4];
  light_row(view, spheres, sphere, SPHERE_WORDS / 4, 0, record);
  const Mask flipped = gather_int((const __global uint*)spheres, sphere * SPHERE_WORDS + 15) != integer(0);
  const Real3 center = real3(record[0], record[1], record[2]);
  const Real radius = record[3], radius2 = radius * radius;
  const Real3 to = sub3(center, p);
  const Real distance2 = dot3(to, to);
  const Mask by_cone = sphere_by_cone(radius2, distance2, flipped);
  if (any(mask & by_cone)) {
    const Real3 axis = scale3(to, real(1.0f) / sqrt_real(distance2));
    const Real one_minus_cos = sphere_cone(radius2, distance2);
    const Real3 toward = sample_cone(u1, u2, one_minus_cos);
    Real3 t, b;
    make_frame(axis, &t, &b);
    const Mask m = mask & by_cone;
    const Real sin2 = fma(toward.x, toward.x, toward.y * toward.y);
    const Real along = fma(toward.z, sqrt_real(distance2), -safe_sqrt(fma(-distance2, sin2, radius2)));
    s->direction = select3(m, normalize3(to_world(axis, t, b, toward)), s->direction);
    s->distance = m ? along : s->distance;
    s->pdf = m ? real(0.5f * STOKES_INV_PI) / one_minus_cos : s->pdf;
  }
  if (any(mask & !by_cone)) {
    const Real3 n = sample_uniform_sphere(u1, u2);
    const Real3 front = scale3(n, flipped ? real(-1.0f) : real(1.0f));
    aim_at(p, madd3(center, n, radius), front, real(STOKES_INV_4PI) / radius2, mask & !by_cone, s);
  }
}

/// Row i of the inverse transpose of the map from the unit sphere, applied to n: the normal, scaled by the change of area over |det|.
STOKES_FN Real3 ellipsoid_normal(const __global float* to_local, Int at, Real3 n) {
  const Real3 row_x = gather_real3(to_local, at), row_y = gather_real3(to_local, at + 4), row_z = gather_real3(to_local, at + 8);
  return madd3(madd3(scale3(row_x, n.x), row_y, n.y), row_z, n.z);
}

/// |det| of the map from the unit sphere to the world.
STOKES_FN Real ellipsoid_volume_scale(const __global float* to_world, Int at) {
  const Real3 x = gather_real3(to_world, at), y = gather_real3(to_world, at + 4), z = gather_real3(to_world, at + 8);
  return abs_real(dot3(x, cross3(y, z)));
}

/// Where the map from the unit sphere puts n.
STOKES_FN Real3 ellipsoid_light_point(const SceneView* view, Int ellipsoid, Real3 n) {
  const __global float* words = (const __global float*)view->ellipsoids;
  const Int m = ellipsoid * ELLIPSOID_WORDS + 12;
  const Real3 x = gather_real3(words, m), y = gather_real3(words, m + 4), z = gather_real3(words, m + 8);
  const Real3 center = real3(gather_real(words, m + 3), gather_real(words, m + 7), gather_real(words, m + 11));
  return add3(center, real3(dot3(x, n), dot3(y, n), dot3(z, n)));
}

/// Uniform on the unit sphere before the map; the density by area follows from how the map stretches there.
STOKES_FN void ellipsoid_light_sample(const SceneView* view, Int ellipsoid, Real3 p, Real u1, Real u2, Mask mask, LightSample* s) {
  const __global float* words = (const __global float*)view->ellipsoids;
  const Int at = ellipsoid * ELLIPSOID_WORDS;
  const Int m = at + 12;
  const Real3 n = sample_uniform_sphere(u1, u2);
  const Real3 target = ellipsoid_light_point(view, ellipsoid, n);
  const Real3 normal = ellipsoid_normal(words, at, n);
  const Real length = sqrt_real(dot3(normal, normal));
  const Mask flipped = gather_int((const __global uint*)words, at + 26) != integer(0);
  const Real3 front = scale3(normal, (flipped ? real(-1.0f) : real(1.0f)) / length);
  aim_at(p, target, front, real(STOKES_INV_4PI) / (ellipsoid_volume_scale(words, m) * length), mask, s);
}

// ---- The surroundings ------------------------------------------------------------------------------------------
STOKES_FN void surroundings_sample(const SceneView* view, Int type, Real u1, Real u2, Mask mask, LightSample* s) {
  Real3 direction = sample_uniform_sphere(u1, u2);
  Real pdf = real(STOKES_INV_4PI);
  if (SCENE_HAS_ENVIRONMENT) {
    const Mask image = mask & (type == integer(LIGHT_ENVIRONMENT));
    Real image_pdf;
    const Real3 to_image = environment_sample(view, u1, u2, &image_pdf);
    direction = select3(image, to_image, direction);
    pdf = image ? image_pdf : pdf;
  }
  s->direction = select3(mask, direction, s->direction);
  s->distance = mask ? real(STOKES_FAR) : s->distance;
  s->pdf = mask ? pdf : s->pdf;
}

// ---- All lights ------------------------------------------------------------------------------------------------

/// Chooses a light by power (alias method); *probability receives that of the choice.
STOKES_FN Int light_choose(const SceneView* view, Real u, Real* probability) {
  const __global uint* words = (const __global uint*)view->lights;
  const __global float* reals = (const __global float*)view->lights;
  const int count = (int)view->scene->light_count;
  *probability = real(1.0f);
  if (count == 1) return integer(0);
  const Real x = u * real((float)count);
  const Int i = min_int(to_int(x), integer(count - 1));
  const Mask keep = x - to_real(i) < gather_real(reals, i * LIGHT_WORDS + 4);
  const Int light = keep ? i : gather_int(words, i * LIGHT_WORDS + 5);
  *probability = gather_real(reals, light * LIGHT_WORDS + 3);
  return light;
}

/// The random numbers of a light sample.
typedef struct {
  Real choice, u1, u2;
} LightNumbers;

/// A place that stands for what light_sample does with the same numbers: its very point, or a sphere's centre. *size2 receives a small part of
/// the light's area. Returns the lanes that have one: the surroundings are nowhere.
STOKES_FN Mask light_place(const SceneView* view, const LightNumbers* u, Mask mask, Real3* place, Real* size2) {
  const __global uint* words = (const __global uint*)view->lights;
  Real probability;
  const Int light = light_choose(view, u->choice, &probability);
  const Int type = gather_int(words, light * LIGHT_WORDS);
  const Int primitive = gather_int(words, light * LIGHT_WORDS + 1);
  *place = real3(real(0.0f), real(0.0f), real(0.0f));
  *size2 = gather_real((const __global float*)view->lights, light * LIGHT_WORDS + 6) * real(0.25f * STOKES_INV_4PI);
  if (SCENE_HAS_QUADS) {
    const Mask m = mask & (type == integer(LIGHT_QUAD));
    Real area;
    if (any(m)) *place = select3(m, quad_light_point(view, m ? primitive : integer(0), u->u1, u->u2, &area), *place);
  }
  if (SCENE_HAS_SPHERES) {
    const Mask m = mask & (type == integer(LIGHT_SPHERE));
    Real record[4];
    if (any(m)) light_row(view, (const __global float*)view->spheres, m ? primitive : integer(0), SPHERE_WORDS / 4, 0, record);
    if (any(m)) *place = select3(m, real3(record[0], record[1], record[2]), *place);
  }
  if (SCENE_HAS_ELLIPSOIDS) {
    const Mask m = mask & (type == integer(LIGHT_ELLIPSOID));
    if (any(m)) *place = select3(m, ellipsoid_light_point(view, m ? primitive : integer(0), sample_uniform_sphere(u->u1, u->u2)), *place);
  }
  if (SCENE_HAS_TRIANGLES) {
    const Mask m = mask & (type == integer(LIGHT_TRIANGLE));
    Real3 normal;
    if (any(m)) *place = select3(m, triangle_light_point(view, m ? primitive : integer(0), u->u1, u->u2, &normal), *place);
  }
  return mask & (type < integer(LIGHT_BACKGROUND));
}

/// Samples a direction from p towards some light. The scene must have a light.
STOKES_FN LightSample light_sample(const SceneView* view, Real3 p, const LightNumbers* u, Mask mask) {
  const __global uint* words = (const __global uint*)view->lights;
  LightSample s;
  Real probability;
  s.light = light_choose(view, u->choice, &probability);
  s.direction = real3(real(0.0f), real(0.0f), real(1.0f));
  s.distance = real(1.0f);
  s.pdf = real(0.0f);
  const Int type = gather_int(words, s.light * LIGHT_WORDS);
  const Int primitive = gather_int(words, s.light * LIGHT_WORDS + 1);
#define STOKES_LIGHT_CASE(present, kind, sampler)                                             \
  if (present) {                                                                              \
    const Mask m = mask & (type == integer(kind));                                            \
    if (any(m)) sampler(view, m ? primitive : integer(0), p, u->u1, u->u2, m, &s);          \
  }
  STOKES_LIGHT_CASE(SCENE_HAS_QUADS, LIGHT_QUAD, quad_light_sample)
  STOKES_LIGHT_CASE(SCENE_HAS_SPHERES, LIGHT_SPHERE, sphere_light_sample)
  STOKES_LIGHT_CASE(SCENE_HAS_ELLIPSOIDS, LIGHT_ELLIPSOID, ellipsoid_light_sample)
  STOKES_LIGHT_CASE(SCENE_HAS_TRIANGLES, LIGHT_TRIANGLE, triangle_light_sample)
#undef STOKES_LIGHT_CASE
  if (SCENE_HAS_BACKGROUND || SCENE_HAS_ENVIRONMENT) {
    const Mask m = mask & (type >= integer(LIGHT_BACKGROUND));
    if (any(m)) surroundings_sample(view, type, u->u1, u->u2, m, &s);
  }
  s.pdf = s.pdf * probability;
  return s;
}

/// Density with which light_sample at `from` would have taken direction d to the point of light `light` at distance t, whose geometric
/// normal makes cosine `cosine` > 0 with -d.
STOKES_FN Real light_pdf(const SceneView* view, Int light, Real3 from, Real3 point, Real3 d, Real cosine, Mask mask) {
  const __global uint* words = (const __global uint*)view->lights;
  const __global float* reals = (const __global float*)view->lights;
  const Int at = (mask ? light : integer(0)) * LIGHT_WORDS;
  const Int type = gather_int(words, at);
  const Int primitive = gather_int(words, at + 1);
  const Real3 way = sub3(point, from);
  const Real spread = dot3(way, way) / max_real(cosine, real(1e-9f));
  Real pdf = spread / gather_real(reals, at + 6);
  if (SCENE_HAS_SPHERES) {
    const Mask m = mask & (type == integer(LIGHT_SPHERE));
    if (any(m)) {
      Real record[4];
      const Int sphere = m ? primitive : integer(0);
      gather_real4((const __global float*)view->spheres, sphere * (SPHERE_WORDS / 4), record);
      const Mask flipped = gather_int((const __global uint*)view->spheres, sphere * SPHERE_WORDS + 15) != integer(0);
      const Real3 to = sub3(real3(record[0], record[1], record[2]), from);
      const Real distance2 = dot3(to, to), radius2 = record[3] * record[3];
      const Real by_cone = real(0.5f * STOKES_INV_PI) / sphere_cone(radius2, distance2);
      const Real by_area = spread * real(STOKES_INV_4PI) / radius2;
      pdf = m ? (sphere_by_cone(radius2, distance2, flipped) ? by_cone : by_area) : pdf;
    }
  }
  if (SCENE_HAS_ELLIPSOIDS) {
    const Mask m = mask & (type == integer(LIGHT_ELLIPSOID));
    if (any(m)) {
      const __global float* ellipsoids = (const __global float*)view->ellipsoids;
      const Int e = (m ? primitive : integer(0)) * ELLIPSOID_WORDS;
      const Real3 x = gather_real3(ellipsoids, e), y = gather_real3(ellipsoids, e + 4), z = gather_real3(ellipsoids, e + 8);
      const Real3 shift = real3(gather_real(ellipsoids, e + 3), gather_real(ellipsoids, e + 7), gather_real(ellipsoids, e + 11));
      const Real3 n = normalize3(add3(shift, real3(dot3(x, point), dot3(y, point), dot3(z, point))));
      const Real3 normal = ellipsoid_normal(ellipsoids, e, n);
      const Real stretch = ellipsoid_volume_scale(ellipsoids, e + 12) * sqrt_real(dot3(normal, normal));
      pdf = m ? spread * real(STOKES_INV_4PI) / stretch : pdf;
    }
  }
  if (SCENE_HAS_BACKGROUND || SCENE_HAS_ENVIRONMENT) {
    pdf = type == integer(LIGHT_BACKGROUND) ? real(STOKES_INV_4PI) : pdf;
    if (SCENE_HAS_ENVIRONMENT) {
      const Mask m = mask & (type == integer(LIGHT_ENVIRONMENT));
      if (any(m)) pdf = m ? environment_pdf(view, d) : pdf;
    }
  }
  return pdf * gather_real(reals, at + 3);
}
#endif
