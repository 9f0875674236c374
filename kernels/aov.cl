// What the camera's rays met first: the film's albedo, normal, depth and alpha. Knows nothing of what happens afterwards.
#ifndef STOKES_AOV_CL
#define STOKES_AOV_CL
#include "flight.cl"

/// D65 at 10 nm from 280 nm on, relative to its luminance Y: weighs the first hit's albedo, so that the channel shows its colour.
__constant float kD65[51] = {
  0.0f, 0.0f, 0.0341f, 3.2945f, 20.236f, 37.0535f, 39.9488f, 44.9117f, 46.6383f, 52.0891f, 49.9755f, 54.6482f, 82.7549f, 91.486f, 93.4318f,
  86.6823f, 104.865f, 117.008f, 117.812f, 114.861f, 115.923f, 108.811f, 109.354f, 107.802f, 104.79f, 107.689f, 104.405f, 104.046f, 100.0f,
  96.3342f, 95.788f, 88.6856f, 90.0062f, 89.5991f, 87.6987f, 83.2886f, 83.6992f, 80.0268f, 80.2146f, 82.2778f, 78.2842f, 69.7213f, 71.6091f,
  74.349f, 61.604f, 69.8856f, 75.087f, 63.5927f, 46.4182f, 66.8054f, 63.3828f};
// int ybar over int D65 ybar, at 1 nm: makes the luminance of D65 one.
#define D65_SCALE (106.8569f / 10566.864f)

STOKES_FN Real d65_lanes(Real lambda) {
  const Real x = (lambda - real(STOKES_LAMBDA_MIN)) * 0.1f;
  const Int i = max_int(min_int(to_int(x), integer(49)), integer(0));
  float low[LANES], high[LANES];
  int at[LANES];
  store_int(i, at);
  for (int j = 0; j < LANES; j++) {
    low[j] = kD65[at[j]];
    high[j] = kD65[at[j] + 1];
  }
  return fma(x - to_real(i), load_real(high) - load_real(low), load_real(low)) * D65_SCALE;
}

/// Linear sRGB of a reflectance seen under D65, at the camera's wavelengths; exactly 1 for white.
STOKES_FN Real3 albedo_rgb(const SceneView* view, const Spectrum* lambda, const Spectrum* inverse_pdf, const Spectrum* albedo, Mask white) {
  Real3 rgb = real3(real(0.0f), real(0.0f), real(0.0f));
  if (SCENE_RGB) {
    rgb = real3(albedo->v[0], albedo->v[1 % WAVELENGTHS], albedo->v[2 % WAVELENGTHS]);
  } else {
    FOR_EACH_WAVELENGTH(k) {
      const Real weight = albedo->v[k] * inverse_pdf->v[k] * (1.0f / (float)WAVELENGTHS) * d65_lanes(lambda->v[k]);
      rgb = madd3(rgb, sensor_rgb(view, lambda->v[k]), weight);
    }
  }
  return select3(white, real3(real(1.0f), real(1.0f), real(1.0f)), rgb);
}

/// Notes for the film the surface at `distance`, the first along the camera's ray.
STOKES_FN void note_surface(const SceneView* view, PathState* path, Real distance, const SurfacePoint* point, Mask first) {
  path->alpha = first ? real(1.0f) : path->alpha;
  if (FILM_CHANNELS & FILM_DEPTH) path->depth = first ? distance : path->depth;
  if (FILM_CHANNELS & FILM_NORMAL) path->normal = select3(first, point->ns, path->normal);
  if (FILM_CHANNELS & FILM_ALBEDO) {
    const Mask outside = dot3(path->direction, point->ng) < real(0.0f);
    Rng spare = path->rng;  // the channel may choose another component of a blend than the path
    const Int material = material_resolve(view, point, neg3(path->direction), &spare, first);
    // The camera's wavelengths: a dye in the medium may have changed the path's.
    Spectrum lambda = path->throughput.lambda, inverse_pdf = lambda;
    if (!SCENE_RGB) camera_wavelengths(view, path->camera_u, &lambda, &inverse_pdf);
    const Bsdf b = bsdf_load(view, material, point, outside, &lambda, first);
    const Mask white = b.specular | bsdf_is(&b, MATERIAL_DIELECTRIC) | bsdf_is(&b, MATERIAL_INTERFACE);
    path->albedo = select3(first, albedo_rgb(view, &lambda, &inverse_pdf, &b.color, white), path->albedo);
  }
}

/// Notes for the film the first surface along the camera's ray, which began at `origin`.
///
/// Depth, normal and albedo describe surfaces only: where a medium around the camera scatters the path before it meets one, the surface
/// beyond is looked for. Such a medium is opaque without end, so alpha is 1 there.
STOKES_FN void note_first_hit(const SceneView* view, PathState* path, const Flight* flight, const SurfacePoint* point, Real3 origin,
                              Counters* counters) {
  const Mask first = path->unseen & (flight->at_surface | flight->in_medium);
  path->unseen = path->unseen & !path->alive;
  if (!any(first)) return;
  note_surface(view, path, flight->length, point, first & flight->at_surface);
  const Mask scattered = first & flight->in_medium;
  if (!SCENE_HAS_MEDIA || !any(scattered)) return;
  path->alpha = scattered ? real(1.0f) : path->alpha;
  if (!(FILM_CHANNELS & (FILM_DEPTH | FILM_NORMAL | FILM_ALBEDO))) return;
  const Hit hit = closest_hit(view, origin, path->direction, real(STOKES_FAR), integer(-1), scattered);
  count_lanes(counters, COUNTER_RAYS, scattered);
  const Mask found = scattered & (hit.primitive >= integer(0));
  if (!any(found)) return;
  const SurfacePoint beyond = surface_point(view, origin, path->direction, hit, found);
  note_surface(view, path, hit.t, &beyond, found);
}
#endif
