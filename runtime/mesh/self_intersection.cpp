// Faces are sorted into the cells of a grid about as wide as they are, and compared within a cell.
#include "mesh/self_intersection.h"

#include <algorithm>
#include <unordered_map>

namespace stokes {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Whether the open segment p-q passes through the inside of the triangle.
bool pierces(Vec3d p, Vec3d q, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d n = cross(b - a, c - a);
  const double from = dot(p - a, n), to = dot(q - a, n);
  if (from * to >= 0) return false;
  const Vec3d x = p + (q - p) * (from / (from - to));
  return dot(cross(b - a, x - a), n) > 0 && dot(cross(c - b, x - b), n) > 0 && dot(cross(a - c, x - c), n) > 0;
}

bool cross_each_other(const MeshData& mesh, const Triangle& s, const Triangle& t) {
  for (const std::uint32_t v : s)
    if (v == t[0] || v == t[1] || v == t[2]) return false;
  const auto at = [&](const Triangle& f, int i) { return mesh.positions[f[i % 3]]; };
  for (int i = 0; i < 3; i++)
    if (pierces(at(s, i), at(s, i + 1), at(t, 0), at(t, 1), at(t, 2)) || pierces(at(t, i), at(t, i + 1), at(s, 0), at(s, 1), at(s, 2))) return true;
  return false;
}

}  // namespace

std::vector<std::uint32_t> self_intersections(const MeshData& mesh) {
  struct Box {
    Vec3d lo, hi;
  };
  std::vector<Box> boxes;
  double size = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    boxes.push_back({min(a, min(b, c)), max(a, max(b, c))});
    size += length(boxes.back().hi - boxes.back().lo) / static_cast<double>(mesh.triangles.size());
  }
  const auto overlap = [&](const Box& a, const Box& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
  };
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells;
  std::vector<bool> hit(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); f++) {
    const Box& b = boxes[f];
    for (std::int64_t i = cell(b.lo.x); i <= cell(b.hi.x); i++)
      for (std::int64_t j = cell(b.lo.y); j <= cell(b.hi.y); j++)
        for (std::int64_t k = cell(b.lo.z); k <= cell(b.hi.z); k++) {
          std::vector<std::uint32_t>& others = cells[(i * 2000003 + j) * 2000003 + k];
          for (const std::uint32_t g : others)
            if (overlap(b, boxes[g]) && cross_each_other(mesh, mesh.triangles[f], mesh.triangles[g])) hit[f] = hit[g] = true;
          others.push_back(f);
        }
  }
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < hit.size(); f++)
    if (hit[f]) faces.push_back(f);
  return faces;
}

}  // namespace stokes
