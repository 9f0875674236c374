// Offsets of meshes: along vertex normals, and as a level of the exact distance.
#include "mesh/offset.h"

#include <stdexcept>

#include "mesh/in_parallel.h"
#include "mesh/mesh_distance.h"
#include "mesh/shell_level.h"
#include "mesh/shell_repair.h"

namespace stokes {
namespace {

Vec3d face_normal(const MeshData& m, const std::array<std::uint32_t, 3>& t) {
  return cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]);
}

constexpr int kGrids = 1;  // that are tried at most
constexpr double kAccepted = 1e-3;  // the share of faces off the distance for which no other mesh is tried

std::vector<Vec3d> vertex_normals(const MeshData& m) {
  std::vector<Vec3d> normals(m.positions.size());
  for (const auto& t : m.triangles)
    for (const std::uint32_t v : t) normals[v] += face_normal(m, t);
  for (Vec3d& n : normals) n = length(n) > 0 ? normalize(n) : Vec3d{0, 1, 0};
  return normals;
}

double mean_edge(const MeshData& m) {
  double sum = 0;
  for (const auto& t : m.triangles) sum += length(m.positions[t[1]] - m.positions[t[0]]);
  return sum / static_cast<double>(std::max<std::size_t>(1, m.triangles.size()));
}

// The offset with the mesh's own connectivity: each vertex moves to where the planes of its faces, shifted by d, meet in the least
// squares sense, so that the facets stay parallel to their parents.
MeshData shift_faces(const MeshData& mesh, double d) {
  struct Normal {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3d b;
  };
  std::vector<Normal> sums(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vec3d area = face_normal(mesh, t);
    const double w = length(area);
    if (w <= 0) continue;
    const Vec3d n = area / w;
    for (std::uint32_t v : t) {
      Normal& s = sums[v];
      s.xx += w * n.x * n.x, s.xy += w * n.x * n.y, s.xz += w * n.x * n.z;
      s.yy += w * n.y * n.y, s.yz += w * n.y * n.z, s.zz += w * n.z * n.z;
      s.b += n * (w * d);
    }
  }
  MeshData out = mesh;
  for (std::size_t i = 0; i < sums.size(); i++) {
    Normal s = sums[i];
    // A flat neighbourhood leaves the tangent open: the solution is held to a step along the mean normal that reaches the planes on average.
    const double weight = s.xx + s.yy + s.zz, e = 1e-2 * weight;
    const double mean = length(s.b) / std::abs(d);  // |sum of w n|
    if (e <= 0 || mean <= 0) continue;
    s.b += s.b * (e * std::min(weight / mean, 2.0) / mean);
    s.xx += e, s.yy += e, s.zz += e;
    const Vec3d c0{s.xx, s.xy, s.xz}, c1{s.xy, s.yy, s.yz}, c2{s.xz, s.yz, s.zz};
    const double det = dot(c0, cross(c1, c2));
    out.positions[i] += Vec3d{dot(s.b, cross(c1, c2)), dot(c0, cross(s.b, c2)), dot(c0, cross(c1, s.b))} / det;
  }
  return out;
}

// Masks and uvs of the nearest points of the parent.
void inherit(MeshData& shell, const MeshData& parent, const MeshDistance& distance) {
  shell.masks.clear(), shell.uvs.clear();
  if (parent.masks.empty() && parent.uvs.empty()) return;
  std::vector<MeshPoint> feet(shell.positions.size());
  in_parallel(feet.size(), [&](std::size_t v) { feet[v] = distance.nearest(shell.positions[v]); });
  for (const auto& mask : parent.masks) shell.masks.emplace_back(mask.first, std::vector<float>());
  for (const MeshPoint& at : feet) {
    const auto& t = parent.triangles[at.triangle];
    for (std::size_t m = 0; m < parent.masks.size(); m++) {
      double value = 0;
      for (int i = 0; i < 3; i++) value += at.weights[i] * parent.masks[m].second[t[i]];
      shell.masks[m].second.push_back(static_cast<float>(std::clamp(value, 0.0, 1.0)));
    }
    if (parent.uvs.empty()) continue;
    std::array<double, 2> uv = {0, 0};
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) uv[c] += at.weights[i] * parent.uvs[t[i]][c];
    shell.uvs.push_back(uv);
  }
}

}  // namespace

MeshData offset_along_normals(const MeshData& mesh, double d, std::size_t* flipped) {
  std::vector<Vec3d> normals = mesh.normals;
  if (normals.empty()) {
    normals.resize(mesh.positions.size());
    for (const auto& t : mesh.triangles)
      for (std::uint32_t v : t) normals[v] += face_normal(mesh, t);
  }
  MeshData out = mesh;
  for (std::size_t i = 0; i < out.positions.size(); i++)
    if (length(normals[i]) > 0) out.positions[i] += normalize(normals[i]) * d;
  if (flipped) {
    *flipped = 0;
    for (const auto& t : mesh.triangles) *flipped += dot(face_normal(mesh, t), face_normal(out, t)) < 0;
  }
  return out;
}

MeshData offset_by_distance_field(const MeshData& mesh, double d, double step, std::size_t* faulty) {
  const MeshTopology topology = mesh_topology(mesh);
  if (!topology.watertight())
    throw std::runtime_error("the mesh is not closed (" + std::to_string(topology.boundary_edges) + " open and " +
                             std::to_string(topology.nonmanifold_edges) + " overloaded edges), so it has no inside to offset into");
  const MeshDistance distance(mesh);
  Vec3d lo = mesh.positions[0], hi = lo;
  for (const Vec3d& p : mesh.positions) lo = min(lo, p), hi = max(hi, p);
  // As fine as the distance asks and the mesh itself is, never so fine that it has many times the mesh's faces or outgrows memory.
  const double edge = mean_edge(mesh);
  if (step <= 0) step = std::max(std::clamp(std::abs(d), 0.4 * edge, 0.8 * edge), length(hi - lo) / 500);
  MeshData out = shift_faces(mesh, d);
  ShellFaults faults = repair_shell(out, distance, d);
  const auto accepted = [&] { return faults.sum() == faults.off_faces && static_cast<double>(faults.off_faces) < kAccepted * static_cast<double>(out.triangles.size()); };
  for (int i = 0; i < kGrids && !accepted(); i++, step *= 0.7) {
    MeshData level = distance_level(distance, lo, hi, d, step);
    const ShellFaults left = repair_shell(level, distance, d);
    if (worse(faults, left)) out = std::move(level), faults = left;
  }
  if (faulty) *faulty = faults.sum();
  inherit(out, mesh, distance);
  if (out.triangles.empty()) throw std::runtime_error("nothing of the mesh is left at that distance");
  out.normals = vertex_normals(out);
  return out;
}

}  // namespace stokes
