// One flight of a path: through its medium until it scatters there, reaches a surface or leaves the scene. Knows nothing of what happens then.
#ifndef STOKES_FLIGHT_CL
#define STOKES_FLIGHT_CL
#include "equiangular.cl"
#include "fluorescence.cl"
#include "path.cl"

// The empty ball pays where surfaces are dear to find and no dye needs to know how far they are.
#ifndef STOKES_EMPTY_BALL
#define STOKES_EMPTY_BALL (SCENE_HAS_MEDIA && SCENE_HAS_TRIANGLES && !SCENE_HAS_FLUORESCENT_MEDIA)
#endif
// In mean free paths: how far to look for surfaces, and below which radius looking was in vain.
#ifndef BALL_REACH
#define BALL_REACH 10.0f
#define BALL_TOO_SMALL 1.5f
#define BALL_PAUSE 2
#endif
// Only media much denser than the scene is large.
#define BALL_DENSITY 0.1f

/// Where along a flight through a thin medium the light of a lamp is sought.
typedef struct {
  Mask chosen;            // in a thin medium: a light was chosen for this flight
  Mask sought;            // it is a lamp, not the surroundings
  LightNumbers numbers;   // of the light, for every vertex that the flight has in the medium
  Equiangular distances;
  Throughput before;      // at the flight's start
  Real share;             // of next-event estimation where the flight itself scatters
} Airlight;

typedef struct {
  Real length;
  Hit hit;
  Mask at_surface, in_medium, escaped;
  Mask glowing;  // in_medium, at a dye
  Airlight airlight;
} Flight;

/// Finds the lanes whose whole flight lies where no surface is (`*clear`: these need not be traced), and those where only the triangles of two
/// leaves may be (returned).
///
/// Paths look around where a flight leaves what is known, and for a few flights not again where that turned out too small. What is known are lower
/// bounds, so no event changes.
STOKES_FN Mask inside_ball(const SceneView* view, PathState* path, Real length, Mask* clear) {
  const Real3 end = madd3(path->origin, path->direction, length);
  const Real mean_free_path = path->medium.mean_free_path;
  const Mask dense = path->alive & (mean_free_path > real(0.0f)) & (mean_free_path < real(BALL_DENSITY * view->scene->scene_radius));
  const Real3 from = sub3(path->origin, path->ball_center), to = sub3(end, path->ball_center);
  Real far2 = max_real(dot3(from, from), dot3(to, to)) * 1.0002f;
  const Mask outside = dense & (far2 >= path->ball.known * path->ball.known);
  const Mask asking = outside & (path->ball_wait <= integer(0));
  path->ball_wait = outside ? path->ball_wait - 1 : path->ball_wait;
  if (any(asking)) {
    const Neighbourhood n = look_around(view, path->origin, mean_free_path * BALL_REACH, asking);
    path->ball_center = select3(asking, path->origin, path->ball_center);
    path->ball.clear = asking ? n.clear : path->ball.clear;
    path->ball.known = asking ? n.known : path->ball.known;
    path->ball.first = asking ? n.first : path->ball.first;
    path->ball.second = asking ? n.second : path->ball.second;
    path->ball_wait = asking ? (n.known < mean_free_path * BALL_TOO_SMALL ? integer(BALL_PAUSE) : integer(0)) : path->ball_wait;
    far2 = asking ? length * length * 1.0002f : far2;
  }
  *clear = dense & (far2 < path->ball.clear * path->ball.clear);
  return dense & !*clear & (far2 < path->ball.known * path->ball.known);
}

/// Whether a way is so short for sigma_t that transmittance hardly changes along it.
STOKES_FN Mask is_thin(Real sigma_t, Real length) { return !(sigma_t * length > real(1e-4f)); }

/// int_0^length e^(-sigma_t x) dx; 0 for a way without end through nothing.
STOKES_FN Real seen_length(Real sigma_t, Real length) {
  const Real thick = (real(1.0f) - exp_real(-sigma_t * length)) / sigma_t;
  const Real thin = length < real(STOKES_FAR) ? length * fma(real(-0.5f) * sigma_t, length, real(1.0f)) : real(0.0f);
  return is_thin(sigma_t, length) ? thin : thick;
}

/// The fluorescent branch of the masked lanes' flights, at media with dyes; `length` is the way to the surface, or STOKES_FAR.
///
/// Along the way the dyes give off light by chance: with probability q = w / (1 + w) the path looks for it at a point drawn as a free flight
/// that ends before the surface, else it flies on as if there were none. w is the light's estimated weight. Returns the lanes that found a
/// dye; *place receives where.
STOKES_FN Mask dyes_along(const SceneView* view, PathState* path, Real length, Mask mask, Real* place) {
  const Int at = (mask ? path->medium.index : integer(0)) * MEDIUM_WORDS;
  const Int first = gather_int((const __global uint*)view->media, at + 4), count = gather_int((const __global uint*)view->media, at + 5);
  const Mask dyed = mask & (count > integer(0));
  Throughput* t = &path->throughput;
  const Real sigma_t = medium_hero_sigma_t(&path->medium, t);
  const Mask endless = (length >= real(STOKES_FAR)) & !(sigma_t > real(0.0f));
  const Mask lanes = dyed & !endless;
  if (!any(lanes)) return no_lanes();
  const Real u_branch = path_random(path, lanes), u_dye = path_random(path, lanes), u_place = path_random(path, lanes), u_lambda = path_random(path, lanes);
  const DyeChoice c = dye_choose(view, t, first, count, u_dye, lanes, 0);

  // Per slot, were it the hero: the branch's probability. A dye's light is estimated by its emission times the way that it is seen through.
  const Spectrum ones = spectrum_constant(real(1.0f));
  const Real beta = beta_sum(t, &ones);
  const Real glow = beta > real(0.0f) ? c.total / beta : real(0.0f);
  Spectrum q;
  FOR_EACH_WAVELENGTH(k) {
    const Real w = glow * seen_length(medium_sigma_t(&path->medium, k), length);
    q.v[k] = w / (real(1.0f) + w);
  }
  const Real hero_q = hero_value(t, &q);
  const Mask found = lanes & (u_branch < hero_q);
  throughput_scale(t, real(1.0f) / (real(1.0f) - hero_q), lanes & !found);
  FOR_EACH_WAVELENGTH(k) {
    const Real ratio = (real(1.0f) - q.v[k]) / (real(1.0f) - hero_q);
    t->density.v[k] = (lanes & !found) ? t->density.v[k] * ratio : t->density.v[k];
  }
  if (!any(found)) return found;

  // The place, with density q T(x) / (int of T along the way); T is the transmittance.
  const Real seen = seen_length(sigma_t, length);
  const Real x = is_thin(sigma_t, length) ? u_place * length : -log_real(fma(-u_place * seen, sigma_t, real(1.0f))) / sigma_t;
  *place = found ? min_real(x, length) : *place;
  const Real hero_density = hero_q * exp_real(-sigma_t * x) / seen;
  FOR_EACH_WAVELENGTH(k) {
    const Real s = medium_sigma_t(&path->medium, k);
    const Real transmitted = exp_real(-s * x);
    const Real density = q.v[k] * transmitted / max_real(seen_length(s, length), real(1e-30f));
    t->beta.v[k] = found ? t->beta.v[k] * transmitted / hero_density : t->beta.v[k];
    t->density.v[k] = found ? t->density.v[k] * density / hero_density : t->density.v[k];
  }
  Throughput excited = *t;
  dye_excite(view, t, &c, u_lambda, found, &excited);
  *t = excited;
  path->fluoresced = path->fluoresced | found;
  // Coefficients at the new wavelengths.
  medium_load(view, path->medium.index, t, found, &path->medium);
  return found;
}

/// Chooses a light for the flights through thin media that may still scatter.
STOKES_FN void airlight_choose(const SceneView* view, PathState* path, Airlight* a, Real3* place, Real* size2) {
  const Int max_bounces = integer((int)min(view->scene->max_bounces, 0x7fffffffu));
  const Mask thin = path->alive & ((path->medium.flags & (int)MEDIUM_THIN) != integer(0)) & (path->bounces < max_bounces);
  a->share = real(1.0f);
  a->chosen = thin;
  a->sought = no_lanes();
  if (!any(thin)) return;
  a->numbers.choice = path_random(path, thin);
  a->numbers.u1 = path_random(path, thin);
  a->numbers.u2 = path_random(path, thin);
  a->sought = light_place(view, &a->numbers, thin, place, size2);
}

/// The sum over the slots of their path densities.
STOKES_FN Real density_sum(const Throughput* t) {
  if (!STOKES_HERO_DENSITIES) return real(1.0f);
  Real sum = real(0.0f);
  FOR_EACH_WAVELENGTH(k) sum += t->density.v[k];
  return sum;
}

/// What next-event estimation counts for at a vertex at `distance` along the flight, by the balance heuristic: the flights of all slots, whose
/// densities of scattering there sum up to `scattering`, might have found it, and so might the search along the way.
STOKES_FN Real airlight_share(const Airlight* a, Real distance, Real scattering) {
  const Real searching = equiangular_pdf(&a->distances, distance) * density_sum(&a->before);
  return scattering > real(0.0f) ? scattering / (scattering + searching) : real(0.0f);
}

/// Flies all living lanes and charges their throughput for the way.
STOKES_FN Flight path_fly(const SceneView* view, PathState* path, Counters* counters) {
  Flight f;
  f.length = real(STOKES_FAR);
  Mask tracing = path->alive, near = no_lanes();
  Real3 lamp;
  Real lamp_size2;
  f.airlight.chosen = f.airlight.sought = no_lanes();
  if (SCENE_HAS_THIN_MEDIA) airlight_choose(view, path, &f.airlight, &lamp, &lamp_size2);
  if (SCENE_HAS_MEDIA) {
    const Real u = random_next(&path->rng);
    f.length = medium_flight(&path->medium, &path->throughput, u);
    if (STOKES_EMPTY_BALL) {
      Mask clear;
      near = inside_ball(view, path, f.length, &clear);
      tracing = tracing & !clear;
    }
  }
  Real reach = f.length;
  Mask dyed = no_lanes();
  if (SCENE_HAS_FLUORESCENT_MEDIA) {
    dyed = path->alive & (path->medium.index != integer(0));
    reach = dyed ? real(STOKES_FAR) : reach;
  }
  if (SCENE_HAS_THIN_MEDIA) reach = f.airlight.sought ? real(STOKES_FAR) : reach;
  f.hit.primitive = integer(-1);
  f.hit.t = f.hit.u = f.hit.v = real(0.0f);
  if (any(tracing)) f.hit = closest_hit_near(view, path->origin, path->direction, reach, path->exclude, tracing, &path->ball, near & (reach <= f.length));
  count_lanes(counters, COUNTER_RAYS, tracing);
  f.at_surface = path->alive & (f.hit.primitive >= integer(0));
  f.glowing = no_lanes();
  if (SCENE_HAS_FLUORESCENT_MEDIA) {
    if (any(dyed)) f.glowing = dyes_along(view, path, f.at_surface ? f.hit.t : real(STOKES_FAR), dyed, &f.length);
    f.at_surface = f.at_surface & !f.glowing & (f.hit.t < f.length);
  }
  if (SCENE_HAS_THIN_MEDIA) {
    if (any(f.airlight.sought))
      f.airlight.distances = equiangular_towards(path->origin, path->direction, lamp, lamp_size2, f.at_surface ? f.hit.t : real(STOKES_FAR));
    f.airlight.before = path->throughput;
    f.at_surface = f.at_surface & (f.hit.t < f.length);
  }
  f.in_medium = SCENE_HAS_MEDIA ? path->alive & !f.at_surface & (f.glowing | (f.length < real(STOKES_FAR))) : no_lanes();
  f.escaped = path->alive & !f.at_surface & !f.in_medium;
  f.length = f.at_surface ? f.hit.t : f.length;
  if (SCENE_HAS_MEDIA) {
    medium_travel(&path->medium, &path->throughput, f.length, path->alive & !f.glowing, f.in_medium & !f.glowing);
    count_lanes(counters, COUNTER_SCATTERINGS, f.in_medium);
    const Mask shared = SCENE_HAS_THIN_MEDIA ? f.in_medium & f.airlight.sought : no_lanes();
    if (any(shared)) {
      const Real sigma_t = medium_hero_sigma_t(&path->medium, &path->throughput);
      const Real scattering = sigma_t * exp_real(-sigma_t * f.length) * density_sum(&path->throughput);
      f.airlight.share = shared ? airlight_share(&f.airlight, f.length, scattering) : f.airlight.share;
    }
  }
  return f;
}
#endif
