// The first surface along a ray, found by testing every primitive in double precision: for the few rays that compiling needs.
#pragma once
#include <optional>

#include "compiled/compiled_scene.h"
#include "math/vec.h"

namespace stokes::compiled {

struct FirstHit {
  double t;
  std::uint32_t primitive;  ///< global index: quads, spheres, ellipsoids, triangles
  std::uint32_t surface;
  Vec3d normal;             ///< unit, of the front side
};

/// Hits with t > 0; `direction` need not be normalised.
std::optional<FirstHit> first_hit(const CompiledScene& scene, Vec3d origin, Vec3d direction);

}  // namespace stokes::compiled
