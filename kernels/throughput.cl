// What a path carries for each of its wavelengths, and how light that it meets counts for the camera. Knows no geometry.
//
// Slot k started as camera wavelength k. All slots share one path, drawn for the hero's wavelength (slot 0; in RGB mode with chromatic
// media any channel). The one-sample multiple importance weight over the choice of the hero is N / sum_j density_j.
// A fluorescent event *mixes*: from then on the slots are N samples of one integral over excitation wavelengths, which camera slot j
// sees with weight mixture_j.
#ifndef STOKES_THROUGHPUT_CL
#define STOKES_THROUGHPUT_CL
#include "spectrum.cl"

// Whether the paths' densities depend on which slot is the hero.
#define STOKES_HERO_DENSITIES SCENE_HAS_CHROMATIC_MEDIA
// Whether wavelengths change along a path.
#define STOKES_FLUORESCENCE \
  (!SCENE_RGB && (SCENE_HAS_FLUORESCENT_SURFACES || SCENE_HAS_FLUORESCENT_MEDIA || SCENE_HAS_RERADIATION))

typedef struct {
  Spectrum lambda;   // nm, of the present leg
  Spectrum beta;     // path contribution over the hero's path density
  Spectrum density;  // path density for slot k over the hero's; read only with STOKES_HERO_DENSITIES
  Spectrum lamp;     // radiance of the scene's only light at lambda, or unset (lone_lamp)
  Spectrum mixture;  // camera slot j's weight of the mixed slots; read only where mixed
  Mask mixed;
  Mask alone;  // dispersion has ended the secondaries
  Int hero;    // RGB mode with chromatic media; otherwise 0
} Throughput;

/// The spectrum of the scene's only light, or -1. It shines alike everywhere, so a path reads its radiance once for all its vertices.
STOKES_FN int lone_lamp(const SceneView* view) {
  if (view->scene->light_count != 1u) return -1;
  return max((int)view->lights[0].emission, -1);
}

/// Reads the lamp at the masked lanes' wavelengths, which have changed.
STOKES_FN void throughput_see_lamp(const SceneView* view, Throughput* t, Mask mask) {
  const int emission = lone_lamp(view);
  if (emission < 0 || !any(mask)) return;
  t->lamp = select_spectrum(mask, spectrum_eval(view, integer(emission), &t->lambda), t->lamp);
}

/// The hero's component of a spectrum.
STOKES_FN Real hero_value(const Throughput* t, const Spectrum* s) {
  if (!(SCENE_RGB && STOKES_HERO_DENSITIES)) return s->v[0];
  Real value = s->v[0];
  FOR_EACH_WAVELENGTH(k) value = t->hero == integer(k) ? s->v[k] : value;
  return value;
}

/// N / sum_j density_j: between 0 and N, 1 when all wavelengths would have taken this path alike.
STOKES_FN Real hero_share(const Throughput* t) {
  if (!STOKES_HERO_DENSITIES) return real(1.0f);
  Real sum = real(0.0f);
  FOR_EACH_WAVELENGTH(k) sum += t->density.v[k];
  return real((float)WAVELENGTHS) / sum;
}

/// Adds light arriving along the path, times `weight`, to the camera slots' sums of the masked lanes.
STOKES_FN void collect_light(const Throughput* t, const Spectrum* light, Real weight, Mask mask, Spectrum* sums) {
  const Real share = hero_share(t) * weight;
  Spectrum part;
  FOR_EACH_WAVELENGTH(k) part.v[k] = t->beta.v[k] * light->v[k] * share;
  if (STOKES_FLUORESCENCE) {
    Real mean = real(0.0f);
    FOR_EACH_WAVELENGTH(k) mean = fma(part.v[k], real(1.0f / (float)WAVELENGTHS), mean);
    FOR_EACH_WAVELENGTH(k) part.v[k] = t->mixed ? t->mixture.v[k] * mean : part.v[k];
  }
  FOR_EACH_WAVELENGTH(k) sums->v[k] = mask ? sums->v[k] + part.v[k] : sums->v[k];
}

/// The most that unit light would still count for any camera slot: what Russian roulette goes by. All wavelengths count alike.
STOKES_FN Real throughput_power(const Throughput* t) {
  Real largest = real(0.0f), mean = real(0.0f), mixture = real(0.0f);
  FOR_EACH_WAVELENGTH(k) largest = max_real(t->beta.v[k], largest);
  if (STOKES_FLUORESCENCE) {
    FOR_EACH_WAVELENGTH(k) mean = fma(t->beta.v[k], real(1.0f / (float)WAVELENGTHS), mean);
    FOR_EACH_WAVELENGTH(k) mixture = max_real(t->mixture.v[k], mixture);
    largest = t->mixed ? mean * mixture : largest;
  }
  return largest * hero_share(t);
}

/// Multiplies the masked lanes by a factor that is the same for all slots.
STOKES_FN void throughput_scale(Throughput* t, Real factor, Mask mask) {
  FOR_EACH_WAVELENGTH(k) t->beta.v[k] = mask ? t->beta.v[k] * factor : t->beta.v[k];
}
/// Multiplies the masked lanes by a spectrum.
STOKES_FN void throughput_filter(Throughput* t, const Spectrum* factor, Mask mask) {
  FOR_EACH_WAVELENGTH(k) t->beta.v[k] = mask ? t->beta.v[k] * factor->v[k] : t->beta.v[k];
}

/// Multiplies the masked lanes' densities by a spectrum.
STOKES_FN void throughput_filter_density(Throughput* t, const Spectrum* factor, Mask mask) {
  FOR_EACH_WAVELENGTH(k) t->density.v[k] = mask ? t->density.v[k] * factor->v[k] : t->density.v[k];
}

/// Replaces the masked lanes by another throughput, times `scale`.
STOKES_FN void throughput_adopt(Throughput* t, const Throughput* other, Real scale, Mask mask) {
  t->lambda = select_spectrum(mask, other->lambda, t->lambda);
  t->beta = select_spectrum(mask, other->beta, t->beta);
  t->lamp = select_spectrum(mask, other->lamp, t->lamp);
  t->density = select_spectrum(mask, other->density, t->density);
  t->mixture = select_spectrum(mask, other->mixture, t->mixture);
  t->mixed = (mask & other->mixed) | (!mask & t->mixed);
  t->alone = (mask & other->alone) | (!mask & t->alone);
  throughput_scale(t, scale, mask);
}

/// Ends the secondary wavelengths of the masked lanes, where the path's way depends on the hero's alone: it then counts N-fold.
STOKES_FN void end_secondaries(Throughput* t, Mask mask) {
  if (STOKES_HERO_DENSITIES) {
    // With the other densities at 0, hero_share is N.
    FOR_EACH_WAVELENGTH(k) if (k > 0) t->density.v[k] = mask ? real(0.0f) : t->density.v[k];
  } else {
    t->beta.v[0] = (mask & !t->alone) ? t->beta.v[0] * real((float)WAVELENGTHS) : t->beta.v[0];
  }
  FOR_EACH_WAVELENGTH(k) if (k > 0) t->beta.v[k] = mask ? real(0.0f) : t->beta.v[k];
  t->alone = t->alone | mask;
}
#endif
