// Kernels that call one device function each on arrays, LANES elements a work-item, for the tests to compare with double precision.
// Arrays are padded to whole groups of lanes.
#include "camera.cl"
#include "intersect.cl"
#include "probe_lanes.cl"
#include "random.cl"
#include "sampling.cl"
#include "spectrum.cl"
#include "texture.cl"

#define SCENE_ARGUMENTS                                                                                                         \
  const __global Scene *scene, const __global float *bvh_nodes, const __global float *bvh_leaves, const __global Quad *quads,   \
      const __global Sphere *spheres, const __global Ellipsoid *ellipsoids, const __global Triangle *triangles,                 \
      const __global Vec3 *positions, const __global Vec3 *normals, const __global float *uvs, const __global Surface *surfaces,\
      const __global Material *materials, const __global Texture *textures, const __global Region *regions,                     \
      const __global float *texels, const __global float *spectra, const __global Medium *media, const __global Dye *dyes,      \
      const __global Distribution *distributions, const __global float *cdfs, const __global Reradiation *reradiations,         \
      const __global float *reradiation_values, const __global Light *lights, const __global Environment *environment,          \
      const __global float *environment_cdf, const __global float *camera_knots, const __global float *sensor
#define SCENE_VIEW                                                                                                          \
  const SceneView scene_view = {scene,       bvh_nodes, bvh_leaves, quads,         spheres,      ellipsoids,         triangles, \
                                positions,   normals,   uvs,        surfaces,      materials,    textures,           regions,   \
                                texels,      spectra,   media,      dyes,          distributions, cdfs,              reradiations, \
                                reradiation_values, lights, environment, environment_cdf, camera_knots, sensor};             \
  const SceneView* view = &scene_view

STOKES_FN void put_int(__global int* p, Int i, Int x) {
  int values[LANES], ids[LANES];
  store_int(x, values), store_int(i, ids);
  for (int j = 0; j < LANES; j++) p[ids[j]] = values[j];
}
STOKES_FN void put3(__global float* p, Int i, Real3 x) {
  put(p, i * 3, x.x), put(p, i * 3 + 1, x.y), put(p, i * 3 + 2, x.z);
}

// ---- Elementary functions ------------------------------------------------------------------------------------
__kernel void probe_math(int op, const __global float* xs, const __global float* ys, __global float* a, __global float* b) {
  const Int i = elements();
  const Real x = gather_real(xs, i), y = gather_real(ys, i);
  Real s = real(0.0f), c = real(0.0f);
  if (op == 0) s = log_real(x);
  if (op == 1) s = exp_real(x);
  if (op == 2) s = pow_real(x, y);
  if (op == 3) sincos_2pi(x, &s, &c);
  if (op == 4) sincos_real(x, &s, &c);
  if (op == 5) s = atan2_real(x, y);
  if (op == 6) s = acos_real(x);
  if (op == 7) s = sqrt_real(x), c = x / y;
  if (op == 8) s = safe_sqrt(x), c = copysign_real(x, y);
  put(a, i, s);
  put(b, i, c);
}

/// draws numbers of each stream, stream by stream
__kernel void probe_random(uint seed, int draws, const __global uint* pixels, const __global uint* samples, __global float* out) {
  const Int i = elements();
  Rng rng = random_start(as_uint_lanes(gather_int(pixels, i)), as_uint_lanes(gather_int(samples, i)), seed);
  for (int k = 0; k < draws; k++) put(out, i * draws + k, random_next(&rng));
}

/// Draws with a mask that excludes every other lane's odd draws: the streams must not notice.
__kernel void probe_random_where(uint seed, int draws, const __global uint* pixels, const __global uint* samples, __global float* out) {
  const Int i = elements();
  Rng rng = random_start(as_uint_lanes(gather_int(pixels, i)), as_uint_lanes(gather_int(samples, i)), seed);
  Int drawn = integer(0);
  for (int k = 0; k < 2 * draws; k++) {
    const Mask m = (((i & 1) == integer(0)) | ((integer(k) & 1) == integer(0))) & (drawn < integer(draws));
    const Real u = random_next_where(&rng, m);
    float values[LANES];
    int ids[LANES], go[LANES];
    store_real(u, values), store_int(i * draws + drawn, ids), store_int(m ? integer(1) : integer(0), go);
    for (int j = 0; j < LANES; j++)
      if (go[j]) out[ids[j]] = values[j];
    drawn = m ? drawn + 1 : drawn;
  }
}

// ---- Sampling ------------------------------------------------------------------------------------------------
__kernel void probe_sampling(int op, float parameter, const __global float* us, const __global float* vs, __global float* out) {
  const Int i = elements();
  const Real u = gather_real(us, i), v = gather_real(vs, i);
  Real3 r = real3(real(0.0f), real(0.0f), real(0.0f));
  if (op == 0) r = sample_cosine_hemisphere(u, v);
  if (op == 1) r = sample_uniform_sphere(u, v);
  if (op == 2) r = sample_cone(u, v, real(parameter));
  if (op == 3) sample_disk(u, v, &r.x, &r.y);
  if (op == 4) sample_triangle(u, v, &r.x, &r.y);
  put3(out, i, r);
}

__kernel void probe_frame(const __global float* normals, __global float* ts, __global float* bs) {
  const Int i = elements();
  Real3 t, b;
  make_frame(gather_real3(normals, i * 3), &t, &b);
  put3(ts, i, t);
  put3(bs, i, b);
}

// ---- Spectra -------------------------------------------------------------------------------------------------
__kernel void probe_spectrum(SCENE_ARGUMENTS, const __global uint* tables, const __global float* lambdas, __global float* out) {
  SCENE_VIEW;
  const Int i = elements();
  put(out, i, spectrum_eval1(view, gather_int(tables, i), gather_real(lambdas, i)));
}
__kernel void probe_distribution(SCENE_ARGUMENTS, const __global uint* ids, const __global float* us, __global float* lambdas,
                                 __global float* pdfs, __global float* evaluated) {
  SCENE_VIEW;
  const Int i = elements(), id = gather_int(ids, i);
  Real pdf;
  const Real lambda = distribution_sample(view, id, gather_real(us, i), all_lanes(), &pdf);
  put(lambdas, i, lambda);
  put(pdfs, i, pdf);
  put(evaluated, i, distribution_pdf(view, id, lambda));
}
__kernel void probe_strata(SCENE_ARGUMENTS, const __global float* us, __global float* least, __global float* most) {
  SCENE_VIEW;
  const Int i = elements();
  Real low = real(1.0f), high = real(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    const Real x = stratum(gather_real(us, i), k);
    low = min_real(low, x);
    high = max_real(high, x);
  }
  put(least, i, low);
  put(most, i, high);
}
__kernel void probe_wavelengths(SCENE_ARGUMENTS, const __global float* us, __global float* lambdas, __global float* inverse_pdfs,
                                __global float* rgb) {
  SCENE_VIEW;
  const Int i = elements();
  Spectrum lambda, inverse_pdf;
  camera_wavelengths(view, gather_real(us, i), &lambda, &inverse_pdf);
  FOR_EACH_WAVELENGTH(k) {
    put(lambdas, i * WAVELENGTHS + k, lambda.v[k]);
    put(inverse_pdfs, i * WAVELENGTHS + k, inverse_pdf.v[k]);
  }
  if (!SCENE_RGB) put3(rgb, i, sensor_rgb(view, lambda.v[0]));
}

// ---- Rays ----------------------------------------------------------------------------------------------------
// A ray is eight floats: origin, direction, tmax, and the bits of `exclude`.
STOKES_FN Int load_ray(const __global float* rays, Int i, Real3* o, Real3* d, Real* tmax) {
  *o = gather_real3(rays, i * 8);
  *d = gather_real3(rays, i * 8 + 3);
  *tmax = gather_real(rays, i * 8 + 6);
  return gather_int((const __global uint*)rays, i * 8 + 7);
}

__kernel void probe_closest(SCENE_ARGUMENTS, const __global float* rays, __global int* primitives, __global float* tuv) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Hit hit = closest_hit(view, o, d, tmax, exclude, all_lanes());
  put_int(primitives, i, hit.primitive);
  put3(tuv, i, real3(hit.t, hit.u, hit.v));
}

__kernel void probe_occluded(SCENE_ARGUMENTS, const __global float* rays, __global int* blocked) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Mask m = occluded(view, o, d, tmax, exclude, all_lanes());
  put_int(blocked, i, m ? integer(1) : integer(0));
}

/// 16 floats a ray: position, ng, ns, offset origin along ng, error, u, v, and the bits of the surface.
__kernel void probe_surface(SCENE_ARGUMENTS, const __global float* rays, __global int* primitives, __global float* out) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Hit hit = closest_hit(view, o, d, tmax, exclude, all_lanes());
  const SurfacePoint point = surface_point(view, o, d, hit, hit.primitive >= integer(0));
  const Real3 front = offset_origin(&point, point.ng);
  put_int(primitives, i, hit.primitive);
  const Real values[16] = {point.position.x, point.position.y, point.position.z, point.ng.x, point.ng.y, point.ng.z, point.ns.x, point.ns.y,
                           point.ns.z, front.x, front.y, front.z, point.error, point.u, point.v, as_real(point.surface)};
  for (int k = 0; k < 16; k++) put(out, i * 16 + k, values[k]);
}

/// From the hit of each ray, continues along `next` from the error-bounded origin; reports what that meets.
__kernel void probe_leave(SCENE_ARGUMENTS, const __global float* rays, const __global float* next, __global int* left,
                          __global int* met, __global float* distances) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Hit hit = closest_hit(view, o, d, tmax, exclude, all_lanes());
  const SurfacePoint point = surface_point(view, o, d, hit, hit.primitive >= integer(0));
  // `next` is given in the frame of ng.
  Real3 t, b;
  make_frame(point.ng, &t, &b);
  const Real3 onwards = to_world(point.ng, t, b, gather_real3(next, i * 3));
  const Hit second = closest_hit(view, offset_origin(&point, onwards), onwards, real(1e18f), hit.primitive, hit.primitive >= integer(0));
  put_int(left, i, hit.primitive);
  put_int(met, i, second.primitive);
  put(distances, i, second.t);
}

__kernel void probe_clearance(SCENE_ARGUMENTS, float radius, const __global float* points, __global float* out) {
  SCENE_VIEW;
  const Int i = elements();
  put(out, i, look_around(view, gather_real3(points, i * 3), real(radius), all_lanes()).clear);
}

/// Rays of the length that is known around their origins: what they meet in the whole scene, and among what is said to be near.
__kernel void probe_neighbourhood(SCENE_ARGUMENTS, float radius, const __global float* points, const __global float* directions,
                                  __global float* known, __global int* met, __global int* met_near, __global float* t, __global float* t_near) {
  SCENE_VIEW;
  const Int i = elements();
  const Real3 o = gather_real3(points, i * 3), d = gather_real3(directions, i * 3);
  const Neighbourhood n = look_around(view, o, real(radius), all_lanes());
  const Hit all = closest_hit(view, o, d, n.known, integer(-1), all_lanes());
  const Hit near = closest_hit_near(view, o, d, n.known, integer(-1), n.clear < n.known, &n, all_lanes());
  put(known, i, n.known);
  put_int(met, i, all.primitive);
  put_int(met_near, i, near.primitive);
  put(t, i, all.t);
  put(t_near, i, near.t);
}

__kernel void probe_camera(SCENE_ARGUMENTS, const __global float* xs, const __global float* ys, const __global float* us,
                           const __global float* vs, __global float* os, __global float* ds) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  camera_ray(view, gather_real(xs, i), gather_real(ys, i), gather_real(us, i), gather_real(vs, i), &o, &d);
  put3(os, i, o);
  put3(ds, i, d);
}

// ---- Textures ------------------------------------------------------------------------------------------------
__kernel void probe_color(SCENE_ARGUMENTS, const __global float* rays, const __global uint* refs, const __global float* lambdas,
                          __global float* out, __global float* points) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Hit hit = closest_hit(view, o, d, tmax, exclude, all_lanes());
  const Mask m = hit.primitive >= integer(0);
  const SurfacePoint point = surface_point(view, o, d, hit, m);
  Spectrum lambda;
  FOR_EACH_WAVELENGTH(k) lambda.v[k] = gather_real(lambdas, i * WAVELENGTHS + k);
  const Spectrum color = color_eval(view, gather_int(refs, i), &point, &lambda, m);
  FOR_EACH_WAVELENGTH(k) put(out, i * WAVELENGTHS + k, color.v[k]);
  const Real values[8] = {point.position.x, point.position.y, point.position.z, point.u, point.v, point.b1, point.b2, as_real(hit.primitive)};
  for (int k = 0; k < 8; k++) put(points, i * 8 + k, values[k]);
}

__kernel void probe_scalar(SCENE_ARGUMENTS, const __global float* rays, const __global uint* textures_of, __global float* out,
                           __global float* points) {
  SCENE_VIEW;
  const Int i = elements();
  Real3 o, d;
  Real tmax;
  const Int exclude = load_ray(rays, i, &o, &d, &tmax);
  const Hit hit = closest_hit(view, o, d, tmax, exclude, all_lanes());
  const Mask m = hit.primitive >= integer(0);
  const SurfacePoint point = surface_point(view, o, d, hit, m);
  put(out, i, scalar_eval(view, gather_int(textures_of, i), &point, neg3(d), m));
  const Real values[8] = {point.position.x, point.position.y, point.position.z, point.u, point.v, point.b1, point.b2, as_real(hit.primitive)};
  for (int k = 0; k < 8; k++) put(points, i * 8 + k, values[k]);
}
