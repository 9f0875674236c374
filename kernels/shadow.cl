// Shadow rays: whether a light is seen, and what the media on the way leave of it. Index-matched boundaries only change the medium.
#ifndef STOKES_SHADOW_CL
#define STOKES_SHADOW_CL
#include "path.cl"

// A shadow ray ends this much, relatively, before its light.
#define STOKES_SHADOW_REACH 0.9999f
#define STOKES_SHADOW_CROSSINGS 256

typedef struct {
  Real3 origin, direction;
  Real distance;  // to the light
  Int exclude;    // primitive it starts on, or -1
  Int medium;     // in which it starts
} ShadowRay;

/// Adds sigma_t times length to the masked lanes' optical depths. `known` spares the tables where the path itself is in that medium.
STOKES_FN void add_optical_depth(const SceneView* view, Int medium, Real length, const Spectrum* lambda, const MediumState* known, Mask mask,
                                 Spectrum* depth) {
  const Mask same = known ? mask & (medium == known->index) : no_lanes();
  const Mask other = mask & !same & (medium != integer(0));
  if (known) FOR_EACH_WAVELENGTH(k) depth->v[k] = same ? fma(medium_sigma_t(known, k), length, depth->v[k]) : depth->v[k];
  if (any(other)) {
    const Spectrum sigma_t = medium_extinction(view, other ? medium : integer(0), lambda);
    FOR_EACH_WAVELENGTH(k) depth->v[k] = other ? fma(sigma_t.v[k], length, depth->v[k]) : depth->v[k];
  }
}

/// e^-depth
STOKES_FN Spectrum transmittance(const Spectrum* depth) {
  if (!SCENE_HAS_MEDIA) return spectrum_constant(real(1.0f));
  if (!SCENE_HAS_CHROMATIC_MEDIA) return spectrum_constant(exp_real(-depth->v[0]));
  Spectrum t;
  FOR_EACH_WAVELENGTH(k) t.v[k] = exp_real(-depth->v[k]);
  return t;
}

/// Follows the ray from boundary to boundary; returns the lanes that reach the light. *depth and, where given, *other_depth receive optical
/// depths at the path's wavelengths and at *other_lambda.
STOKES_FN Mask shadow_walk(const SceneView* view, ShadowRay* ray, const PathState* path, const Spectrum* other_lambda, Mask active, Counters* counters,
                           Spectrum* depth, Spectrum* other_depth) {
  Mask open = no_lanes(), walking = active;
  for (int crossings = 0; crossings < STOKES_SHADOW_CROSSINGS; crossings++) {
    count_lanes(counters, COUNTER_SHADOW_RAYS, walking);
    Hit hit;
    Mask blocked;
    if (SCENE_HAS_INTERFACES) {
      hit = first_obstacle(view, ray->origin, ray->direction, ray->distance * STOKES_SHADOW_REACH, ray->exclude, walking);
      blocked = walking & (hit.primitive >= integer(0));
    } else {
      blocked = occluded(view, ray->origin, ray->direction, ray->distance * STOKES_SHADOW_REACH, ray->exclude, walking);
    }
    const Mask arrived = walking & !blocked;
    Mask crossing = no_lanes();
    if (SCENE_HAS_INTERFACES && any(blocked)) {
      const Int surface = surface_of(view, hit.primitive, blocked);
      const Int flags = gather_int((const __global uint*)view->surfaces, surface * (int)(sizeof(Surface) / 4) + 4);
      crossing = blocked & ((flags & (int)SURFACE_INTERFACE) != integer(0));
    }
    if (SCENE_HAS_MEDIA) {
      const Real length = SCENE_HAS_INTERFACES ? (arrived ? ray->distance : hit.t) : ray->distance;
      add_optical_depth(view, ray->medium, length, &path->throughput.lambda, &path->medium, arrived | crossing, depth);
      if (STOKES_FLUORESCENCE) add_optical_depth(view, ray->medium, length, other_lambda, 0, arrived | crossing, other_depth);
    }
    open = open | arrived;
    walking = crossing;
    if (!SCENE_HAS_INTERFACES || !any(walking)) break;
    // Step over the boundary, into the medium of its far side.
    const SurfacePoint point = surface_point(view, ray->origin, ray->direction, hit, walking);
    const Mask out = dot3(ray->direction, point.ng) > real(0.0f);
    ray->medium = walking ? (out ? point.medium_outside : point.medium_inside) : ray->medium;
    ray->origin = select3(walking, offset_origin(&point, ray->direction), ray->origin);
    ray->distance = walking ? ray->distance - hit.t : ray->distance;
    ray->exclude = walking ? point.primitive : ray->exclude;
  }
  return open;
}

#endif
