// Light of lamps in thin media, sought along a flight. Few flights scatter in a thin medium, and fewer where it counts, near a lamp. So next-event
// estimation is done twice: where the flight itself scatters (if it does), and at a place along it that equiangular sampling favours. Both find
// the same light and share it by the balance heuristic over distances and heroes. The path goes on as if nothing had been sought.
#ifndef STOKES_AIRLIGHT_CL
#define STOKES_AIRLIGHT_CL
#include "direct.cl"
#include "flight.cl"

/// Adds the light that would be scattered towards the path's origin at one place along its flight.
STOKES_APART void collect_airlight(const SceneView* view, PathState* path, const Airlight* a, Counters* counters) {
  const Real distance = equiangular_sample(&a->distances, path_random(path, a->sought));
  const Throughput after = path->throughput;
  const MediumState* m = &path->medium;
  Throughput* t = &path->throughput;
  *t = a->before;

  // As medium_travel, but the slots' transmittances are relative to the largest, not to the hero's, which may vanish here.
  Real clearest = medium_sigma_t(m, 0);
  throughput_filter(t, &m->albedo, a->sought);
  if (SCENE_HAS_CHROMATIC_MEDIA) {
    FOR_EACH_WAVELENGTH(k) clearest = min_real(m->sigma_t.v[k], clearest);
    const Real hero = medium_hero_sigma_t(m, t);
    const Real sigma_s_scale = hero > real(0.0f) ? hero : real(1.0f);
    FOR_EACH_WAVELENGTH(k) {
      const Real ratio = exp_real((clearest - m->sigma_t.v[k]) * distance);
      t->beta.v[k] *= sigma_s_scale * ratio;
      t->density.v[k] *= m->sigma_t.v[k] * ratio;
    }
  }
  const Real event = (SCENE_HAS_CHROMATIC_MEDIA ? real(1.0f) : clearest) * exp_real(-clearest * distance);
  const Real densities = density_sum(t), share = airlight_share(a, distance, event * densities);

  const SurfacePoint nowhere = surface_point_none();
  const Real3 place = madd3(path->origin, path->direction, distance);
  // What comes through all but opaque ways, or from where squared distances overflow, is nothing; its weights would not be finite.
  const Mask useful = a->sought & (share > real(0.0f)) & (densities > real(1e-30f)) & (distance < real(1e15f));
  const Vertex v = vertex_make(view, path, &nowhere, integer(0), place, useful, no_lanes(), no_lanes());
  Excitation none;
  none.lanes = no_lanes();
  none.throughput = *t;
  if (any(useful)) collect_direct(view, path, &v, &nowhere, &none, useful, &a->numbers, share, counters);
  *t = after;
}

/// The numbers of next-event estimation at a vertex. Where a light was chosen for the flight, that is the one: what is sought along the flight and
/// at its end must be the same light.
STOKES_FN LightNumbers light_numbers(PathState* path, const Airlight* a, Mask in_medium, Mask seeking) {
  const Mask chosen = SCENE_HAS_THIN_MEDIA ? in_medium & a->chosen : no_lanes();
  const Mask drawing = seeking & !chosen;
  LightNumbers u;
  u.choice = path_random(path, drawing);
  u.u1 = path_random(path, drawing);
  u.u2 = path_random(path, drawing);
  if (SCENE_HAS_THIN_MEDIA) {
    u.choice = chosen ? a->numbers.choice : u.choice;
    u.u1 = chosen ? a->numbers.u1 : u.u1;
    u.u2 = chosen ? a->numbers.u2 : u.u2;
  }
  return u;
}
#endif
