// What is done to a mesh between its file and its description: faces without area dropped, offset, division by material.
#include "scene/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/mesh_generator.h"

namespace stokes {
namespace {

Vec3d face_cross(const RawMesh& mesh, const std::vector<Vec3d>& positions, std::size_t face) {
  const auto& c = mesh.faces[face].corners;
  return cross(positions[c[1].position] - positions[c[0].position], positions[c[2].position] - positions[c[0].position]);
}

// World normals at positions: the file's where it has any, else the adjacent faces' by angle.
std::vector<Vec3d> position_normals(const RawMesh& mesh, const std::vector<Vec3d>& world, const Affine& to_world) {
  std::vector<Vec3d> given(world.size()), computed(world.size());
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    const auto& c = mesh.faces[f].corners;
    // A mirroring transform turns the winding, but not which side is out.
    Vec3d n = face_cross(mesh, world, f);
    if (to_world.determinant() < 0) n = -n;
    for (int i = 0; i < 3; i++) {
      const Vec3d e1 = world[c[(i + 1) % 3].position] - world[c[i].position], e2 = world[c[(i + 2) % 3].position] - world[c[i].position];
      const double angle = std::atan2(length(cross(e1, e2)), dot(e1, e2));
      computed[c[i].position] += normalize(n) * angle;
      if (c[i].normal >= 0 && length(mesh.normals[c[i].normal]) > 0)
        given[c[i].position] += normalize(to_world.normal(mesh.normals[c[i].normal])) * angle;
    }
  }
  for (std::size_t i = 0; i < world.size(); i++) {
    const Vec3d n = length(given[i]) > 1e-6 ? given[i] : computed[i];
    given[i] = length(n) > 0 ? normalize(n) : Vec3d{};
  }
  return given;
}

}  // namespace

MeshGenerator& mesh_generator() {
  static MeshGenerator generator = nullptr;
  return generator;
}

RawMesh raw_mesh_of(const MeshData& mesh) {
  RawMesh raw;
  raw.positions = mesh.positions;
  raw.normals = mesh.normals;
  raw.uvs = mesh.uvs;
  raw.masks = mesh.masks;
  for (const auto& triangle : mesh.triangles) {
    RawMesh::Face face;
    for (int i = 0; i < 3; i++) {
      const int v = static_cast<int>(triangle[i]);
      face.corners[i] = {v, mesh.normals.empty() ? -1 : v, mesh.uvs.empty() ? -1 : v};
    }
    raw.faces.push_back(face);
  }
  return raw;
}

std::size_t drop_degenerate_faces(RawMesh& mesh) {
  return std::erase_if(mesh.faces, [&](const RawMesh::Face& face) {
    const auto& c = face.corners;
    const Vec3d a = mesh.positions[c[0].position], b = mesh.positions[c[1].position], d = mesh.positions[c[2].position];
    const double longest = std::max({length_squared(b - a), length_squared(d - a), length_squared(d - b)});
    return !(length(cross(b - a, d - a)) > 1e-12 * longest);
  });
}

std::size_t offset_positions(RawMesh& mesh, double distance, const Affine& to_world) {
  std::vector<Vec3d> before, after;
  for (const Vec3d& p : mesh.positions) before.push_back(to_world.point(p));
  const std::vector<Vec3d> normals = position_normals(mesh, before, to_world);
  for (std::size_t i = 0; i < before.size(); i++) after.push_back(before[i] + normals[i] * distance);
  std::size_t flipped = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); f++) flipped += dot(face_cross(mesh, before, f), face_cross(mesh, after, f)) <= 0;
  const Affine to_local = to_world.inverse();
  for (std::size_t i = 0; i < after.size(); i++) mesh.positions[i] = to_local.point(after[i]);
  return flipped;
}

MeshData extract_material(const RawMesh& mesh, int material) {
  bool any_normals = false, any_uvs = false;
  for (const RawMesh::Face& face : mesh.faces)
    for (const RawMesh::Corner& c : face.corners) {
      if (face.material != material) continue;
      any_normals |= c.normal >= 0 && length(mesh.normals[c.normal]) > 0;
      any_uvs |= c.uv >= 0;
    }

  MeshData data;
  for (const auto& mask : mesh.masks) data.masks.push_back({mask.first, {}});
  std::map<std::tuple<int, int, int>, std::uint32_t> known;
  for (std::size_t f = 0; f < mesh.faces.size(); f++) {
    const RawMesh::Face& face = mesh.faces[f];
    if (face.material != material) continue;
    std::array<std::uint32_t, 3> triangle;
    for (int i = 0; i < 3; i++) {
      const RawMesh::Corner& c = face.corners[i];
      const bool has_normal = c.normal >= 0 && length(mesh.normals[c.normal]) > 0;
      // A corner that lacks what others have gets a flat normal or barycentric uvs, and so a vertex of its own.
      const int own = -2 - static_cast<int>(3 * f) - i;
      const std::tuple key{c.position, any_normals ? (has_normal ? c.normal : own) : -1, any_uvs ? (c.uv >= 0 ? c.uv : own) : -1};
      const auto [it, fresh] = known.emplace(key, static_cast<std::uint32_t>(data.positions.size()));
      triangle[i] = it->second;
      if (!fresh) continue;
      data.positions.push_back(mesh.positions[c.position]);
      if (any_normals) data.normals.push_back(normalize(has_normal ? mesh.normals[c.normal] : face_cross(mesh, mesh.positions, f)));
      if (any_uvs) data.uvs.push_back(c.uv >= 0 ? mesh.uvs[c.uv] : std::array<double, 2>{i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0});
      for (std::size_t m = 0; m < mesh.masks.size(); m++) data.masks[m].second.push_back(mesh.masks[m].second[c.position]);
    }
    data.triangles.push_back(triangle);
  }
  return data;
}

}  // namespace stokes
