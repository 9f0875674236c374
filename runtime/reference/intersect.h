// Rays against single primitives in double precision, and what is known about a point on one. Knows nothing of acceleration.
#pragma once
#include <cstdint>
#include <limits>

#include "compiled/compiled_scene.h"
#include "math/vec.h"

namespace stokes::reference {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Vec3d vec(layout::Vec3 v) { return {v.x, v.y, v.z}; }

struct Ray {
  Vec3d o, d;                         ///< d is a unit vector
  std::uint32_t left = STOKES_NONE;   ///< the primitive that `o` lies on, if any
};

/// A global primitive index as a kind and an index within the kind.
enum class PrimitiveKind { Quad, Sphere, Ellipsoid, Triangle };
struct PrimitiveRef {
  PrimitiveKind kind;
  std::uint32_t index;
};
PrimitiveRef primitive_ref(const CompiledScene& scene, std::uint32_t primitive);
/// The inverse of primitive_ref, for a light.
std::uint32_t light_primitive(const CompiledScene& scene, const layout::Light& light);
std::uint32_t primitive_count(const CompiledScene& scene);
/// True for spheres and ellipsoids whose front is their inside; false for STOKES_NONE.
bool is_hollow(const CompiledScene& scene, std::uint32_t primitive);
const layout::Surface& primitive_surface(const CompiledScene& scene, std::uint32_t primitive);

struct Hit {
  double t = kInfinity;
  std::uint32_t primitive = STOKES_NONE;
  double u = 0, v = 0;  ///< quad: its parameters; triangle: barycentrics of v1 and v2
  bool found() const { return primitive != STOKES_NONE; }
};

struct Box {
  Vec3d low, high;
};
Box primitive_bounds(const CompiledScene& scene, std::uint32_t primitive);

/// Takes the hit over if the primitive is met at t in (t_min, hit.t). A ray that starts on the primitive (ray.left) does not find the
/// point it starts from: a flat one is left for good, a sphere or ellipsoid is met only at its other side.
void intersect_primitive(const CompiledScene& scene, std::uint32_t primitive, const Ray& ray, double t_min, Hit& hit);

/// What an integrator asks about a point on a surface.
struct SurfacePoint {
  Vec3d position;
  Vec3d ng;  ///< geometric normal, unit, to the front side
  Vec3d ns;  ///< shading normal, unit, on the side of ng
  double u = 0, v = 0;  ///< texture coordinates
  double b1 = 0, b2 = 0;  ///< triangle: barycentrics of v1 and v2
  std::uint32_t primitive = STOKES_NONE;
  std::uint32_t light = STOKES_NONE;
  const layout::Surface* surface = nullptr;
  PrimitiveKind kind = PrimitiveKind::Quad;

  /// The medium on the side that `direction` points into.
  std::uint32_t medium_towards(Vec3d direction) const {
    return dot(direction, ng) > 0 ? surface->medium_outside : surface->medium_inside;
  }
};

/// The point at `position` on a primitive with the parameters of Hit.
SurfacePoint surface_point(const CompiledScene& scene, std::uint32_t primitive, Vec3d position, double u, double v);

/// An ellipsoid's maps in double. The tables hold both in float; `to_world` is the exact inverse of `to_local`, so that the two agree.
struct EllipsoidMaps {
  Affine to_local, to_world;
};
EllipsoidMaps ellipsoid_maps(const layout::Ellipsoid& e);

}  // namespace stokes::reference
