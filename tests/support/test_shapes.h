// Random quads, spheres and ellipsoids for the geometry tests. Knows CompiledScene's arrays only.
#pragma once
#include <random>

#include "compiled/shapes.h"
#include "math/vec.h"
#include "support/test_meshes.h"

namespace stokes::testing {

inline layout::Vec3 to_vec3(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }

inline layout::Quad make_quad(Vec3d corner, Vec3d u, Vec3d v) {
  layout::Quad q{};
  const Vec3d n = normalize(cross(u, v));
  const Vec3d du = cross(v, n) / dot(cross(v, n), u), dv = cross(n, u) / dot(cross(n, u), v);
  q.normal = to_vec3(n);
  q.corner = to_vec3(corner);
  q.edge_u = to_vec3(u);
  q.edge_v = to_vec3(v);
  q.dual_u = to_vec3(du);
  q.dual_v = to_vec3(dv);
  q.offset = float(dot(n, corner));
  q.u0 = float(dot(du, corner));
  q.v0 = float(dot(dv, corner));
  q.area = float(length(cross(u, v)));
  q.light = STOKES_NONE;
  compiled::set_quad_reach(q);
  return q;
}

inline layout::Sphere make_sphere(Vec3d center, double radius, bool flip = false) {
  layout::Sphere s{};
  s.center = to_vec3(center);
  s.radius = float(radius);
  s.to_local[0] = s.to_local[4] = s.to_local[8] = 1;
  s.light = STOKES_NONE;
  s.flip = flip;
  return s;
}

/// `to_world` as three columns and a centre.
inline layout::Ellipsoid make_ellipsoid(Vec3d x, Vec3d y, Vec3d z, Vec3d center, bool flip = false) {
  layout::Ellipsoid e{};
  const double det = dot(x, cross(y, z));
  const Vec3d rows[3] = {cross(y, z) / det, cross(z, x) / det, cross(x, y) / det};
  for (int r = 0; r < 3; r++) {
    const Vec3d row = rows[r];
    const float local[4] = {float(row.x), float(row.y), float(row.z), float(-dot(row, center))};
    const auto pick = [r](Vec3d v) { return float(r == 0 ? v.x : r == 1 ? v.y : v.z); };
    const float world[4] = {pick(x), pick(y), pick(z), pick(center)};
    for (int k = 0; k < 4; k++) e.to_local[4 * r + k] = local[k], e.to_world[4 * r + k] = world[k];
  }
  e.light = STOKES_NONE;
  e.flip = flip;
  return e;
}

struct Numbers {
  std::mt19937 g;
  explicit Numbers(unsigned seed) : g(seed) {}
  double signed_one() { return std::uniform_real_distribution<double>(-1, 1)(g); }
  double one() { return std::uniform_real_distribution<double>(0, 1)(g); }
  Vec3d cube(double size = 1) {
    const double x = signed_one(), y = signed_one(), z = signed_one();
    return {size * x, size * y, size * z};
  }
  Vec3d direction() {
    for (;;) {
      const Vec3d v = cube();
      if (const double l = length(v); l < 1 && l > 0.01) return v / l;
    }
  }
};

/// A scene of shapes alone, with a surface each kind.
inline CompiledScene shapes_scene(int quads, int spheres, int ellipsoids, unsigned seed) {
  CompiledScene s = mesh_scene({}, 8);
  Numbers u(seed);
  for (int i = 0; i < quads; i++) s.quads.push_back(make_quad(u.cube(), u.cube(0.5), u.cube(0.5)));
  for (int i = 0; i < spheres; i++) s.spheres.push_back(make_sphere(u.cube(), 0.02 + 0.2 * u.one(), i % 3 == 0));
  for (int i = 0; i < ellipsoids; i++) {
    const Vec3d x = u.direction() * 0.2, y = normalize(cross(x, u.direction())) * (0.05 + 0.2 * u.one());
    const Vec3d z = cross(normalize(x), normalize(y)) * (i % 2 ? 0.1 : -0.15) + x * 0.2;
    s.ellipsoids.push_back(make_ellipsoid(x, y, z, u.cube(), i % 3 == 0));
  }
  s.header.quad_count = layout::uint(quads);
  s.header.sphere_count = layout::uint(spheres);
  s.header.ellipsoid_count = layout::uint(ellipsoids);
  layout::Surface surface = s.surfaces[0];
  s.surfaces = {surface, surface, surface, surface};
  for (auto& q : s.quads) q.surface = 1;
  for (auto& q : s.spheres) q.surface = 2;
  for (auto& q : s.ellipsoids) q.surface = 3;
  return s;
}

}  // namespace stokes::testing
