// Analytic primitives in world space, and the conversions from the host's doubles to the layout's floats. Knows nothing of
// materials or lights.
#pragma once
#include <optional>

#include "layout.h"
#include "math/vec.h"

namespace stokes::compiled {

inline layout::Vec3 to_float(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }
inline Vec3d to_double(layout::Vec3 v) { return {v.x, v.y, v.z}; }

/// Up to this many quads are tested one by one; more go into the BVH as two triangles each.
inline constexpr std::size_t kMaxAnalyticQuads = 64;

/// Fills the tolerances of a quad whose other members are there. A hit within it is at most |edge_u| + |edge_v| from the corner and
/// the ray's origin sqrt(3) t further (sums of absolute components); rounding is four units in the last place of that and of t.
void set_quad_reach(layout::Quad& quad);

/// The parallelogram that a `width` by `height` rectangle in the local xy-plane becomes. Its front side is where the local +z
/// goes (as a normal), or the other one with `flip`. Empty when it has no area.
std::optional<layout::Quad> make_quad(const Affine& to_world, double width, double height, bool flip);

/// The uniform scale of a map that is a rotation or reflection times a scale; empty for any other.
std::optional<double> uniform_scale(const Affine& a);

/// `to_world` must have a uniform scale.
layout::Sphere make_sphere(const Affine& to_world, double radius, bool flip);
/// `to_world` must be invertible.
layout::Ellipsoid make_ellipsoid(const Affine& to_world, double radius, bool flip);

}  // namespace stokes::compiled
