// The state of LANES paths, how they start, and the light that they gather. Knows no vertices and no loop.
#ifndef STOKES_PATH_CL
#define STOKES_PATH_CL
#include "camera.cl"
#include "film.cl"
#include "intersect.cl"
#include "light.cl"
#include "medium.cl"
#include "random.cl"

// Whether the film keeps what went through fluorescent events apart.
#define STOKES_KEEPS_FLUORESCENCE ((FILM_CHANNELS & FILM_FLUORESCENCE) != 0)

typedef struct {
  Mask alive;
  Rng rng;
  // The ray that is about to fly.
  Real3 origin, direction;
  Int exclude;  // primitive it starts on, or -1
  // The vertex it comes from: interfaces lie between, if anything.
  Real3 vertex;
  Real pdf;  // of the direction at the vertex, per unit solid angle; -1: light that is hit counts in full (camera, specular)
  Int bounces;
  Throughput throughput;
  Real eta_scale;  // undoes the radiance scale of refraction for Russian roulette
  MediumState medium;
  // What surrounds a point that the path came by.
  Real3 ball_center;
  Neighbourhood ball;
  Int ball_wait;  // flights until the next look around
  // What the film will be told.
  Real camera_u;
  Spectrum radiance, fluorescence;  // per camera wavelength
  Mask fluoresced;                  // a fluorescent event lies behind
  Mask unseen;                      // nothing was hit yet
  Real3 albedo, normal;
  Real depth, alpha;
  Real3 rgb;  // previews only, in place of radiance
} PathState;

/// Rays, shadow rays, scatterings in media and paths of one work-item.
typedef struct {
  ulong count[COUNTER_COUNT];
} Counters;
STOKES_FN void count_lanes(Counters* c, int counter, Mask m) { c->count[counter] += popcount(lane_bits(m)); }

/// A uniform number for the masked lanes; only their streams move on, so a path's numbers do not depend on its neighbours.
STOKES_FN Real path_random(PathState* path, Mask mask) { return random_next_where(&path->rng, mask); }

STOKES_FN SurfacePoint surface_point_none(void) {
  SurfacePoint point;
  point.position = point.ng = point.ns = real3(real(0.0f), real(0.0f), real(1.0f));
  point.u = point.v = point.b1 = point.b2 = point.error = real(0.0f);
  point.primitive = point.light = point.emission = integer(-1);
  point.surface = point.material = point.medium_outside = point.medium_inside = point.flags = integer(0);
  return point;
}

STOKES_FN PathState path_none(void) {
  PathState path;
  const Real3 zero = real3(real(0.0f), real(0.0f), real(0.0f));
  const Spectrum black = spectrum_constant(real(0.0f));
  path.alive = path.fluoresced = path.unseen = no_lanes();
  path.rng.state = path.rng.increment = uinteger(1u);
  path.origin = path.vertex = path.ball_center = path.albedo = path.normal = path.rgb = zero;
  path.direction = real3(real(0.0f), real(0.0f), real(1.0f));
  path.exclude = integer(-1);
  path.pdf = path.eta_scale = path.camera_u = path.depth = path.alpha = real(0.0f);
  path.bounces = path.ball_wait = integer(0);
  path.ball = nothing_known();
  path.throughput.lambda = spectrum_constant(real(STOKES_LAMBDA_MIN));
  path.throughput.beta = path.throughput.density = path.throughput.mixture = path.throughput.lamp = black;
  path.throughput.mixed = path.throughput.alone = no_lanes();
  path.throughput.hero = integer(0);
  path.medium.index = path.medium.flags = integer(0);
  path.medium.sigma_t = path.medium.albedo = path.medium.g = black;
  path.medium.mean_free_path = real(0.0f);
  path.radiance = path.fluorescence = black;
  return path;
}

/// A new path in every lane: sample `sample` of the pixel at column x, row y of the full image.
STOKES_FN PathState path_start(const SceneView* view, Uint x, Uint y, Uint sample, uint seed) {
  PathState path = path_none();
  path.rng = random_start(y * view->scene->camera.width + x, sample, seed);
  const Real px = to_real(as_int_lanes(x)) + random_next(&path.rng), py = to_real(as_int_lanes(y)) + random_next(&path.rng);
  path.camera_u = random_next(&path.rng);
  Real lens_u = real(0.0f), lens_v = real(0.0f);
  if (SCENE_HAS_LENS) {
    lens_u = random_next(&path.rng);
    lens_v = random_next(&path.rng);
  }
  camera_ray(view, px, py, lens_u, lens_v, &path.origin, &path.direction);
  path.vertex = path.origin;
  path.pdf = real(-1.0f);
  path.eta_scale = real(1.0f);
  Throughput* t = &path.throughput;
  Spectrum inverse_pdf;
  camera_wavelengths(view, path.camera_u, &t->lambda, &inverse_pdf);
  t->beta = t->density = spectrum_constant(real(1.0f));
  throughput_see_lamp(view, t, all_lanes());
  if (SCENE_RGB && STOKES_HERO_DENSITIES) t->hero = min_int(to_int(path.camera_u * 3.0f), integer(2));
  path.unseen = path.alive = all_lanes();
  if (SCENE_HAS_MEDIA) medium_load(view, integer((int)view->scene->camera.medium), t, all_lanes(), &path.medium);
  return path;
}

#define STOKES_TAKE(kind, field) path->field = mask ? spread_##kind(&from->field, j) : path->field

/// Puts lane j of `from`, which has just started, into the masked lanes.
STOKES_FN void path_take(PathState* path, const PathState* from, uint j, Mask mask) {
  STOKES_TAKE(uint, rng.state);
  STOKES_TAKE(uint, rng.increment);
  STOKES_TAKE(real, origin.x);
  STOKES_TAKE(real, origin.y);
  STOKES_TAKE(real, origin.z);
  STOKES_TAKE(real, direction.x);
  STOKES_TAKE(real, direction.y);
  STOKES_TAKE(real, direction.z);
  STOKES_TAKE(real, vertex.x);
  STOKES_TAKE(real, vertex.y);
  STOKES_TAKE(real, vertex.z);
  STOKES_TAKE(int, exclude);
  STOKES_TAKE(real, camera_u);
  STOKES_TAKE(real, alpha);
  STOKES_TAKE(int, unseen);
  FOR_EACH_WAVELENGTH(k) {
    STOKES_TAKE(real, throughput.lambda.v[k]);
    STOKES_TAKE(real, throughput.lamp.v[k]);
  }
  STOKES_TAKE(int, throughput.hero);
  if (!SCENE_HAS_MEDIA) return;
  STOKES_TAKE(int, medium.index);
  STOKES_TAKE(int, medium.flags);
  STOKES_TAKE(real, medium.mean_free_path);
  FOR_EACH_WAVELENGTH(k) {
    STOKES_TAKE(real, medium.albedo.v[k]);
    if (!SCENE_HAS_CHROMATIC_MEDIA && k > 0) continue;
    STOKES_TAKE(real, medium.sigma_t.v[k]);
    STOKES_TAKE(real, medium.g.v[k]);
  }
}

/// What all new paths have in common.
STOKES_FN void path_reset(PathState* path, Mask fresh) {
  path->alive = path->alive | fresh;
  path->pdf = fresh ? real(-1.0f) : path->pdf;
  path->bounces = fresh ? integer(0) : path->bounces;
  path->eta_scale = fresh ? real(1.0f) : path->eta_scale;
  path->ball.clear = fresh ? real(0.0f) : path->ball.clear;
  path->ball.known = fresh ? real(0.0f) : path->ball.known;
  path->ball_wait = fresh ? integer(0) : path->ball_wait;
  Throughput* t = &path->throughput;
  FOR_EACH_WAVELENGTH(k) {
    t->beta.v[k] = fresh ? real(1.0f) : t->beta.v[k];
    t->density.v[k] = fresh ? real(1.0f) : t->density.v[k];
    path->radiance.v[k] = fresh ? real(0.0f) : path->radiance.v[k];
    path->fluorescence.v[k] = fresh ? real(0.0f) : path->fluorescence.v[k];
  }
  t->mixed = t->mixed & !fresh;
  t->alone = t->alone & !fresh;
  path->fluoresced = path->fluoresced & !fresh;
  const Real3 zero = real3(real(0.0f), real(0.0f), real(0.0f));
  path->albedo = select3(fresh, zero, path->albedo);
  path->normal = select3(fresh, zero, path->normal);
  path->depth = fresh ? real(0.0f) : path->depth;
}

/// Adds light that arrives along the path, times `weight`.
STOKES_FN void path_collect(PathState* path, const Spectrum* light, Real weight, Mask mask) {
  collect_light(&path->throughput, light, weight, mask, &path->radiance);
  if (STOKES_FLUORESCENCE && STOKES_KEEPS_FLUORESCENCE)
    collect_light(&path->throughput, light, weight, mask & path->fluoresced, &path->fluorescence);
}

/// Veach's power heuristic for a direction that was drawn with pdf p and might have been drawn with pdf q.
STOKES_FN Real power_heuristic(Real p, Real q) {
  // Squares of the ratio do not overflow where squares of the densities would.
  const Real ratio = q / p;
  return real(1.0f) / fma(ratio, ratio, real(1.0f));
}

/// How much light counts that the path's ray met by itself, when light sampling would have found it with density pdf_light (0: never).
STOKES_FN Real hit_weight(const PathState* path, Real pdf_light) {
  if (INTEGRATOR == INTEGRATOR_MATS) return real(1.0f);
  const Mask alone = (path->pdf < real(0.0f)) | !(pdf_light > real(0.0f));
  const Real shared = INTEGRATOR == INTEGRATOR_NEE ? real(0.0f) : power_heuristic(path->pdf, pdf_light);
  return alone ? real(1.0f) : shared;
}

/// The light of a surface that the ray has reached, if it shines to this side.
STOKES_FN void collect_emission(const SceneView* view, PathState* path, const SurfacePoint* point, Mask mask) {
  const Real cosine = -dot3(path->direction, point->ng);
  const Mask shines = mask & (point->emission != integer(-1)) & (cosine > real(0.0f));
  if (!any(shines)) return;
  const Spectrum light = color_eval(view, point->emission, point, &path->throughput.lambda, shines);
  const Mask listed = shines & (point->light != integer(-1));
  Real pdf = real(0.0f);
  if (INTEGRATOR != INTEGRATOR_MATS && any(listed))
    pdf = listed ? light_pdf(view, point->light, path->vertex, point->position, path->direction, cosine, listed) : pdf;
  path_collect(path, &light, hit_weight(path, pdf), shines);
}

/// Radiance of the surroundings in direction d.
STOKES_FN Spectrum surroundings_radiance(const SceneView* view, Real3 d, const Spectrum* lambda) {
  if (SCENE_HAS_ENVIRONMENT) return environment_radiance(view, d, lambda);
  const uint background = view->scene->background;
  return background == STOKES_NONE ? spectrum_constant(real(0.0f)) : spectrum_eval(view, integer((int)background), lambda);
}

/// The light of the surroundings, for rays that left the scene.
STOKES_FN void collect_surroundings(const SceneView* view, PathState* path, Mask mask) {
  if (!(SCENE_HAS_BACKGROUND || SCENE_HAS_ENVIRONMENT)) return;
  const Spectrum light = surroundings_radiance(view, path->direction, &path->throughput.lambda);
  const int index = (int)view->scene->background_light;
  Real pdf = real(0.0f);
  if (INTEGRATOR != INTEGRATOR_MATS && index != -1)
    pdf = light_pdf(view, integer(index), path->vertex, path->vertex, path->direction, real(1.0f), mask);
  path_collect(path, &light, hit_weight(path, pdf), mask);
}
#endif
