// Synthetic meshes and scenes for the geometry tests: closed spheres, soups, terrains. Knows CompiledScene's arrays only.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "compiled/bvh.h"
#include "compiled/compiled_scene.h"

namespace stokes::testing {

struct Mesh {
  std::vector<layout::Vec3> positions;
  std::vector<layout::Triangle> triangles;

  void add(layout::uint a, layout::uint b, layout::uint c) { triangles.push_back({a, b, c, 0, STOKES_NONE, 0, 0, 0}); }
};

/// A closed sphere of shared vertices, wound outwards; `bumps` roughens the radius.
inline Mesh sphere_mesh(int rows, int columns, layout::Vec3 center, double radius, double bumps = 0) {
  Mesh m;
  const auto at = [&](double theta, double phi) {
    const double r = radius * (1 + bumps * (std::sin(7 * theta) * std::cos(9 * phi) + 0.5 * std::sin(23 * theta) * std::sin(17 * phi)));
    m.positions.push_back({float(center.x + r * std::sin(theta) * std::cos(phi)), float(center.y + r * std::sin(theta) * std::sin(phi)),
                           float(center.z + r * std::cos(theta))});
  };
  at(0, 0);
  for (int i = 1; i < rows; i++)
    for (int j = 0; j < columns; j++) at(M_PI * i / rows, 2 * M_PI * j / columns);
  at(M_PI, 0);
  const auto vertex = [&](int i, int j) -> layout::uint {
    if (i == 0) return 0;
    if (i == rows) return layout::uint(m.positions.size() - 1);
    return layout::uint(1 + (i - 1) * columns + j % columns);
  };
  for (int i = 0; i < rows; i++)
    for (int j = 0; j < columns; j++) {
      if (i > 0) m.add(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
      if (i < rows - 1) m.add(vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1));
    }
  return m;
}

inline void append(Mesh& to, const Mesh& from) {
  const auto base = layout::uint(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  for (const auto& t : from.triangles) to.add(t.v0 + base, t.v1 + base, t.v2 + base);
}

/// Random triangles of every shape, slivers included, in [-1, 1]^3.
inline Mesh soup_mesh(int count, unsigned seed, double size = 0.2) {
  Mesh m;
  std::mt19937 g(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < count; i++) {
    const double c[3] = {u(g), u(g), u(g)};
    const double stretch = i % 7 == 0 ? 1e-3 : 1;
    for (int k = 0; k < 3; k++)
      m.positions.push_back({float(c[0] + size * u(g)), float(c[1] + size * stretch * u(g)), float(c[2] + size * u(g))});
    const auto base = layout::uint(3 * i);
    m.add(base, base + 1, base + 2);
  }
  return m;
}

/// A scene of one surface (and medium 0 on both sides) around a mesh.
inline CompiledScene mesh_scene(const Mesh& mesh, int bvh_width) {
  CompiledScene s;
  s.header = {};
  s.header.quad_count = s.header.sphere_count = s.header.ellipsoid_count = 0;
  s.positions = mesh.positions;
  s.triangles = mesh.triangles;
  s.header.triangle_count = layout::uint(mesh.triangles.size());
  layout::Surface surface{};
  surface.emission = STOKES_NONE;
  s.surfaces.push_back(surface);
  s.bvh_width = bvh_width;
  if (!mesh.triangles.empty()) {
    const compiled::Bvh bvh = compiled::build_bvh(s.positions, s.triangles, bvh_width);
    s.bvh_nodes = bvh.nodes;
    s.bvh_leaves = bvh.leaves;
  }
  return s;
}

/// Rays as the probes read them: origin, direction, tmax, the bits of `exclude`.
struct Ray {
  float o[3], d[3], tmax = 1e18f;
  std::int32_t exclude = -1;
};
static_assert(sizeof(Ray) == 32);

inline Ray make_ray(double ox, double oy, double oz, double dx, double dy, double dz) {
  const double l = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
  return {{float(ox), float(oy), float(oz)}, {float(dx * l), float(dy * l), float(dz * l)}};
}

inline std::vector<float> ray_floats(const std::vector<Ray>& rays) {
  const auto* p = reinterpret_cast<const float*>(rays.data());
  return {p, p + rays.size() * 8};
}

}  // namespace stokes::testing
