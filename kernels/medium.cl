// Homogeneous media along a path: the coefficients of the medium it is in, free flight, what a stretch does to its throughput.
// Knows no surfaces. A path keeps its medium's coefficients, because most steps of a walk stay in one medium.
#ifndef STOKES_MEDIUM_CL
#define STOKES_MEDIUM_CL
#include "phase.cl"
#include "throughput.cl"
#include "traverse.cl"

#define MEDIUM_WORDS 8

/// Coefficients at the path's wavelengths; vacuum has index 0 and all of them zero.
typedef struct {
  Int index;
  Int flags;
  Spectrum sigma_t;  // per scene unit; all alike (read one) without chromatic media
  Spectrum albedo;   // sigma_s over the hero's sigma_t, or sigma_s itself where that is 0
  Spectrum g;
  Real mean_free_path;  // where sigma_t is largest
} MediumState;

/// sigma_t of slot k.
STOKES_FN Real medium_sigma_t(const MediumState* m, int k) { return SCENE_HAS_CHROMATIC_MEDIA ? m->sigma_t.v[k] : m->sigma_t.v[0]; }
STOKES_FN Real medium_g(const MediumState* m, int k) { return SCENE_HAS_CHROMATIC_MEDIA ? m->g.v[k] : m->g.v[0]; }

/// sigma_t at all of the path's wavelengths, of a medium that need not be the path's.
STOKES_FN Spectrum medium_extinction(const SceneView* view, Int index, const Spectrum* lambda) {
  const __global uint* media = (const __global uint*)view->media;
  const Int table = gather_int(media, index * MEDIUM_WORDS);
  if (SCENE_HAS_CHROMATIC_MEDIA) return spectrum_eval(view, table, lambda);
  return spectrum_constant(spectrum_eval1(view, table, SCENE_RGB ? real(0.0f) : lambda->v[0]));
}

/// Puts the masked lanes into vacuum.
STOKES_FN void medium_leave(Mask mask, MediumState* m) {
  m->index = mask ? integer(0) : m->index;
  m->flags = mask ? integer((int)MEDIUM_ISOTROPIC) : m->flags;
  m->mean_free_path = mask ? real(0.0f) : m->mean_free_path;
  FOR_EACH_WAVELENGTH(k) {
    m->albedo.v[k] = mask ? real(0.0f) : m->albedo.v[k];
    m->sigma_t.v[k] = mask ? real(0.0f) : m->sigma_t.v[k];
    m->g.v[k] = mask ? real(0.0f) : m->g.v[k];
  }
}

/// Reads a medium's coefficients for the masked lanes.
STOKES_FN void medium_load(const SceneView* view, Int index, const Throughput* t, Mask mask, MediumState* m) {
  if (!any(mask & (index != integer(0)))) {
    medium_leave(mask, m);
    return;
  }
  const __global uint* media = (const __global uint*)view->media;
  const Int at = (mask ? index : integer(0)) * MEDIUM_WORDS;
  const Int flags = gather_int(media, at + 3);
  const Spectrum sigma_t = medium_extinction(view, mask ? index : integer(0), &t->lambda);
  const Spectrum sigma_s = spectrum_eval(view, gather_int(media, at + 1), &t->lambda);
  const Real hero_sigma_t = SCENE_HAS_CHROMATIC_MEDIA ? hero_value(t, &sigma_t) : sigma_t.v[0];
  const Real scale = hero_sigma_t > real(0.0f) ? real(1.0f) / hero_sigma_t : real(1.0f);
  m->index = mask ? index : m->index;
  m->flags = mask ? flags : m->flags;
  m->mean_free_path = mask ? gather_real((const __global float*)media, at + 6) : m->mean_free_path;
  const Mask isotropic = (flags & (int)MEDIUM_ISOTROPIC) != integer(0);
  const Int g_table = (mask & !isotropic) ? gather_int(media, at + 2) : integer(0);
  FOR_EACH_WAVELENGTH(k) {
    m->albedo.v[k] = mask ? sigma_s.v[k] * scale : m->albedo.v[k];
    if (!SCENE_HAS_CHROMATIC_MEDIA && k > 0) continue;
    m->sigma_t.v[k] = mask ? sigma_t.v[k] : m->sigma_t.v[k];
    const Real g = spectrum_eval1(view, g_table, SCENE_RGB ? real((float)k) : t->lambda.v[k]);
    m->g.v[k] = mask ? (isotropic ? real(0.0f) : g) : m->g.v[k];
  }
}

/// Makes `index` the medium of the masked lanes.
STOKES_FN void medium_enter(const SceneView* view, Int index, const Throughput* t, Mask mask, MediumState* m) {
  if (!SCENE_HAS_MEDIA) return;
  const Mask changed = mask & (index != m->index);
  if (any(changed)) medium_load(view, index, t, changed, m);
}

/// sigma_t of the hero.
STOKES_FN Real medium_hero_sigma_t(const MediumState* m, const Throughput* t) {
  return SCENE_HAS_CHROMATIC_MEDIA ? hero_value(t, &m->sigma_t) : m->sigma_t.v[0];
}

/// Length of a free flight for the hero's wavelength: density sigma_t exp(-sigma_t t); STOKES_FAR where nothing stops it.
STOKES_FN Real medium_flight(const MediumState* m, const Throughput* t, Real u) {
  const Real sigma_t = medium_hero_sigma_t(m, t);
  const Real length = -log_real(u) / sigma_t;
  return sigma_t > real(0.0f) ? min_real(length, real(STOKES_FAR)) : real(STOKES_FAR);
}

/// The toll of a stretch of `length`, at whose end the path scatters in the medium (`scattered`) or is at a surface or far away.
///
/// Slot k has been offered a path drawn for the hero: its throughput and its own path density over the hero's both take the ratio of the
/// transmittances; at a scattering, sigma_s,k / sigma_t,hero and sigma_t,k / sigma_t,hero besides.
STOKES_FN void medium_travel(const MediumState* m, Throughput* t, Real length, Mask travelling, Mask scattered) {
  throughput_filter(t, &m->albedo, scattered);
  if (!SCENE_HAS_CHROMATIC_MEDIA) return;
  const Real hero = medium_hero_sigma_t(m, t);
  const Real inverse = hero > real(0.0f) ? real(1.0f) / hero : real(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    const Real ratio = exp_real((hero - m->sigma_t.v[k]) * length);
    const Real event = scattered ? m->sigma_t.v[k] * inverse * ratio : ratio;
    t->beta.v[k] = travelling ? t->beta.v[k] * ratio : t->beta.v[k];
    t->density.v[k] = travelling ? t->density.v[k] * event : t->density.v[k];
  }
}
#endif
