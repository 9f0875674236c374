// What is done to a mesh between its file and its description: faces without area dropped, offset, division by material.
#include "scene/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/mesh_distance.h"
#include "mesh/offset.h"

namespace stokes {
namespace {

Vec3d face_cross(const RawMesh& mesh, const std::vector<Vec3d>& positions, std::size_t face) {
  const auto& c = mesh.faces[face].corners;
  return cross(positions[c[1].position] - positions[c[0].position], positions[c[2].position] - positions[c[0].position]);
}

// The positions alone, in world space, and a normal for each: the average of the file's normals there, else that of the adjacent
// faces, both by angle. (By area, a cube's corner would lean towards the side that is divided otherwise.)
MeshData positions_in_world(const RawMesh& mesh, const Affine& to_world) {
  MeshData world;
  for (const Vec3d& p : mesh.positions) world.positions.push_back(to_world.point(p));
  std::vector<Vec3d> given(world.positions.size()), computed(world.positions.size());
  for (const RawMesh::Face& face : mesh.faces) {
    std::array<std::uint32_t, 3> t;
    for (int i = 0; i < 3; i++) t[i] = static_cast<std::uint32_t>(face.corners[i].position);
    // A mirroring transform turns the winding, but not which side is out.
    const bool mirrored = to_world.determinant() < 0;
    if (mirrored) std::swap(t[1], t[2]);
    world.triangles.push_back(t);
    for (int i = 0; i < 3; i++) {
      const Vec3d e1 = world.positions[t[(i + 1) % 3]] - world.positions[t[i]],
                  e2 = world.positions[t[(i + 2) % 3]] - world.positions[t[i]];
      const Vec3d n = cross(e1, e2);
      const double angle = std::atan2(length(n), dot(e1, e2));
      if (length(n) > 0) computed[t[i]] += normalize(n) * angle;
      const int normal = face.corners[mirrored && i > 0 ? 3 - i : i].normal;
      if (normal >= 0 && length(mesh.normals[normal]) > 0) given[t[i]] += normalize(to_world.normal(mesh.normals[normal])) * angle;
    }
  }
  for (std::size_t i = 0; i < given.size(); i++) {
    const Vec3d n = length(given[i]) > 1e-6 ? given[i] : computed[i];
    world.normals.push_back(length(n) > 0 ? normalize(n) : Vec3d{});
  }
  return world;
}

}  // namespace

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
  std::size_t flipped = 0;
  const MeshData moved = offset_along_normals(positions_in_world(mesh, to_world), distance, &flipped);
  const Affine to_local = to_world.inverse();
  for (std::size_t i = 0; i < mesh.positions.size(); i++) mesh.positions[i] = to_local.point(moved.positions[i]);
  return flipped;
}

namespace {

// The uvs of a shell's corners from the nearest points of its parent. A corner that falls onto another chart than the face's middle takes
// what the middle's triangle has there when it is continued in its plane, so that no face is smeared over a seam.
void inherit_uvs(RawMesh& shell, const MeshData& moved, const RawMesh& parent, const MeshData& world, bool mirrored) {
  constexpr double kOtherChart = 0.1;  // further apart in uv than any face of a sensible map is wide
  const MeshDistance distance(world);
  const auto uv_at = [&](std::uint32_t f, const std::array<double, 3>& weights) {
    std::array<double, 2> uv = {0, 0};
    for (int i = 0; i < 3; i++) {
      const int index = parent.faces[f].corners[mirrored && i > 0 ? 3 - i : i].uv;
      for (int c = 0; c < 2 && index >= 0; c++) uv[c] += weights[i] * parent.uvs[index][c];
    }
    return uv;
  };
  for (std::size_t f = 0; f < shell.faces.size(); f++) {
    const auto& t = moved.triangles[f];
    const Vec3d middle = (moved.positions[t[0]] + moved.positions[t[1]] + moved.positions[t[2]]) / 3;
    const std::uint32_t home = distance.nearest(middle).triangle;
    for (int i = 0; i < 3; i++) {
      const Vec3d p = moved.positions[t[i]];
      const MeshPoint at = distance.nearest(p);
      const std::array<double, 2> near = uv_at(at.triangle, at.weights), own = uv_at(home, distance.weights(home, p));
      const bool seam = std::hypot(near[0] - own[0], near[1] - own[1]) > kOtherChart;
      shell.faces[f].corners[i].uv = static_cast<int>(shell.uvs.size());
      shell.uvs.push_back(seam ? own : near);
    }
  }
}

}  // namespace

RawMesh offset_surface(const RawMesh& mesh, double distance, const Affine& to_world, std::size_t* faulty) {
  MeshData world = positions_in_world(mesh, to_world);
  world.masks = mesh.masks;
  MeshData moved = offset_by_distance_field(world, distance, 0, faulty);
  std::vector<Vec3d> places = moved.positions;
  const Affine to_local = to_world.inverse();
  for (Vec3d& p : moved.positions) p = to_local.point(p);
  for (Vec3d& n : moved.normals) n = normalize(to_local.normal(n));
  if (to_world.determinant() < 0)
    for (auto& triangle : moved.triangles) std::swap(triangle[1], triangle[2]);
  RawMesh shell = raw_mesh_of(moved);
  if (!mesh.uvs.empty()) {
    moved.positions = std::move(places);
    inherit_uvs(shell, moved, mesh, world, to_world.determinant() < 0);
  }
  return shell;
}

namespace {

MeshData extract_faces(const RawMesh& mesh, const std::vector<std::size_t>& faces) {
  bool any_normals = false, any_uvs = false;
  for (const std::size_t f : faces)
    for (const RawMesh::Corner& c : mesh.faces[f].corners) {
      any_normals |= c.normal >= 0 && length(mesh.normals[c.normal]) > 0;
      any_uvs |= c.uv >= 0;
    }

  MeshData data;
  for (const auto& mask : mesh.masks) data.masks.push_back({mask.first, {}});
  std::map<std::tuple<int, int, int>, std::uint32_t> known;
  for (const std::size_t f : faces) {
    const RawMesh::Face& face = mesh.faces[f];
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

}  // namespace

std::vector<MeshData> extract_materials(const RawMesh& mesh) {
  std::vector<std::vector<std::size_t>> faces(mesh.materials.size());
  for (std::size_t f = 0; f < mesh.faces.size(); f++) faces[static_cast<std::size_t>(mesh.faces[f].material)].push_back(f);
  std::vector<MeshData> parts;
  for (const auto& of_material : faces) parts.push_back(extract_faces(mesh, of_material));
  return parts;
}

}  // namespace stokes
