// Axis-aligned boxes, and the box around a compiled scene.
#pragma once
#include <limits>

#include "compiled/compiled_scene.h"
#include "math/vec.h"

namespace stokes::compiled {

/// What lies farther from the origin, in scene units, overflows when it is squared in single precision.
constexpr double kFarthestCoordinate = 1e15;

struct Bounds {
  Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec3d high{-low.x, -low.y, -low.z};

  void add(Vec3d p) { low = min(low, p), high = max(high, p); }
  bool empty() const { return !(low.x <= high.x); }
  Vec3d center() const { return empty() ? Vec3d{} : (low + high) / 2; }
  /// Of the sphere around the box; 1 when there is nothing.
  double radius() const { return empty() || !(length(high - low) > 0) ? 1 : length(high - low) / 2; }
};

/// Around all primitives.
Bounds scene_bounds(const CompiledScene& scene);

}  // namespace stokes::compiled
