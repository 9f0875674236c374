// Triangle meshes in world space: vertices, shading normals, texture coordinates, windings.
#include <cmath>

#include "compiled/compilation.h"
#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

// Once one mesh has normals (or uvs), every vertex has an entry, zero where its mesh has none.
void append_normals(Compilation& c, const SurfaceDescription& s, const std::vector<std::uint32_t>& source, std::size_t before) {
  const MeshData& mesh = *s.mesh;
  std::vector<layout::Vec3>& normals = c.out.normals;
  if (mesh.normals.empty()) {
    if (!normals.empty()) normals.resize(c.out.positions.size(), layout::Vec3{0, 0, 0});
    return;
  }
  normals.resize(before, layout::Vec3{0, 0, 0});
  const double sign = s.flip ? -1 : 1;
  for (std::uint32_t v : source) {
    const Vec3d n = s.transform.normal(mesh.normals[v]) * sign;
    const double l = length(n);
    normals.push_back(l > 0 && std::isfinite(l) ? to_float(n / l) : layout::Vec3{0, 0, 0});
  }
  c.out.features.smooth_normals = true;
}

void append_uvs(Compilation& c, const MeshData& mesh, const std::vector<std::uint32_t>& source, std::size_t before) {
  std::vector<float>& uvs = c.out.uvs;
  if (mesh.uvs.empty()) {
    if (!uvs.empty()) uvs.resize(2 * c.out.positions.size(), 0.0f);
    return;
  }
  uvs.resize(2 * before, 0.0f);
  for (std::uint32_t v : source) uvs.push_back(float(mesh.uvs[v][0])), uvs.push_back(float(mesh.uvs[v][1]));
}

void check_mesh(const Compilation& c, const SurfaceDescription& s) {
  const MeshData& mesh = *s.mesh;
  const std::size_t n = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != n) c.fail(s.pointer, "the mesh has another number of normals than of vertices");
  if (!mesh.uvs.empty() && mesh.uvs.size() != n) c.fail(s.pointer, "the mesh has another number of texture coordinates than of vertices");
  for (const auto& t : mesh.triangles)
    for (std::uint32_t v : t)
      if (v >= n) c.fail(s.pointer, "a triangle names vertex " + std::to_string(v) + " of " + std::to_string(n));
}

}  // namespace

void append_mesh(Compilation& c, const SurfaceDescription& s, std::uint32_t index) {
  check_mesh(c, s);
  const MeshData& mesh = *s.mesh;
  const std::size_t before = c.out.positions.size();
  // Mirrored or flipped: the winding is reversed, so that counter-clockwise still means "front".
  const bool reverse = (s.transform.determinant() < 0) != s.flip;

  // Only the vertices that triangles use, in the order of their first use.
  std::vector<std::uint32_t> target(mesh.positions.size(), STOKES_NONE), source;
  const auto vertex = [&](std::uint32_t v) {
    if (target[v] == STOKES_NONE) {
      target[v] = std::uint32_t(before + source.size());
      source.push_back(v);
      const layout::Vec3 p = to_float(s.transform.point(mesh.positions[v]));
      if (!is_finite(to_double(p))) c.fail(s.pointer, "vertex " + std::to_string(v) + " is not finite");
      c.out.positions.push_back(p);
    }
    return target[v];
  };

  std::size_t dropped = 0;
  c.out.triangles.reserve(c.out.triangles.size() + mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    layout::Triangle triangle{};
    triangle.v0 = vertex(t[0]);
    triangle.v1 = vertex(t[reverse ? 2 : 1]);
    triangle.v2 = vertex(t[reverse ? 1 : 2]);
    const Vec3d p = to_double(c.out.positions[triangle.v0]);
    const double area =
        length(cross(to_double(c.out.positions[triangle.v1]) - p, to_double(c.out.positions[triangle.v2]) - p)) / 2;
    if (!(float(area) > 0)) {
      dropped++;
      continue;
    }
    triangle.surface = index;
    triangle.light = STOKES_NONE;
    triangle.area = float(area);
    triangle.mesh = std::uint32_t(c.meshes.size());
    c.out.triangles.push_back(triangle);
  }
  if (dropped) c.warn(c.out.surface_names[index] + ": " + std::to_string(dropped) + " degenerate triangle" + (dropped > 1 ? "s were" : " was") + " dropped");

  append_normals(c, s, source, before);
  append_uvs(c, mesh, source, before);
  if (!mesh.normals.empty()) c.out.surfaces[index].flags |= SURFACE_SMOOTH_NORMALS;
  if (!mesh.uvs.empty()) c.out.surfaces[index].flags |= SURFACE_HAS_UV;
  c.meshes.push_back({s.mesh, std::uint32_t(before), std::move(source)});
}

}  // namespace stokes::compiled
