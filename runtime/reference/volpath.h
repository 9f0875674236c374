// The volumetric path tracer: one wavelength per path, surfaces and media, next-event estimation, multiple importance sampling,
// fluorescence. Also what the first hit tells the film.
#pragma once
#include "reference/world.h"

namespace stokes::reference {

/// What a camera path found: radiance at the camera's wavelength, W m^-2 sr^-1 nm^-1 in the scene's relative unit.
struct PathResult {
  double radiance = 0;
  double fluorescent = 0;  ///< the part of it that came through at least one change of wavelength
};
PathResult trace_path(const World& world, const Ray& camera_ray, Wavelength w, Random& random);

/// The first surface along a camera ray, for alpha and the AOVs.
struct FirstHit {
  bool found = false;
  double depth = 0;
  Vec3d ns;
  double albedo = 0;  ///< at the path's wavelength
};
FirstHit trace_first_hit(const World& world, const Ray& camera_ray, Wavelength w, Random& random);

/// 1 if a cosine-distributed ray from the first hit escapes, else 0; 0 where nothing is hit.
double trace_ambient_occlusion(const World& world, const Ray& camera_ray, Random& random);

}  // namespace stokes::reference
