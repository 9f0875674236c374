// Faces are sorted into the cells of a grid about as wide as they are, and compared within a cell.
#include "mesh/self_intersection.h"

#include <algorithm>

namespace stokes {
namespace {

using Triangle = FaceGrid::Triangle;
using Corners = std::array<Vec3d, 3>;

// Whether the open segment p-q passes through the inside of the triangle.
bool pierces(Vec3d p, Vec3d q, const Corners& t) {
  const auto& [a, b, c] = t;
  const Vec3d n = cross(b - a, c - a);
  const double from = dot(p - a, n), to = dot(q - a, n);
  if (from * to >= 0) return false;
  const Vec3d x = p + (q - p) * (from / (from - to));
  return dot(cross(b - a, x - a), n) > 0 && dot(cross(c - b, x - b), n) > 0 && dot(cross(a - c, x - c), n) > 0;
}

// Whether the triangle lies on one side of the other's plane.
bool aside(const Corners& p, const Corners& q) {
  const Vec3d n = cross(q[1] - q[0], q[2] - q[0]);
  const double a = dot(p[0] - q[0], n), b = dot(p[1] - q[0], n), c = dot(p[2] - q[0], n);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

// s and t are the faces' vertices, p and q where these are.
bool cross_each_other(const Triangle& s, const Triangle& t, const Corners& p, const Corners& q) {
  int shared = 0, of_s = 0, of_t = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (s[i] == t[j]) shared++, of_s = i, of_t = j;
  if (shared > 1) return false;
  // With one corner in common only the sides opposite to it can pass through the other face.
  if (shared == 1) return pierces(p[(of_s + 1) % 3], p[(of_s + 2) % 3], q) || pierces(q[(of_t + 1) % 3], q[(of_t + 2) % 3], p);
  if (aside(p, q) || aside(q, p)) return false;
  for (int i = 0; i < 3; i++)
    if (pierces(p[i], p[(i + 1) % 3], q) || pierces(q[i], q[(i + 1) % 3], p)) return true;
  return false;
}

// Whether the corners lie beyond one side of a box.
template <double Vec3d::*axis>
bool apart(const Corners& p, const Vec3d& lo, const Vec3d& hi) {
  return (p[0].*axis > hi.*axis && p[1].*axis > hi.*axis && p[2].*axis > hi.*axis) ||
         (p[0].*axis < lo.*axis && p[1].*axis < lo.*axis && p[2].*axis < lo.*axis);
}

Vec3d low(const Corners& p) { return min(p[0], min(p[1], p[2])); }
Vec3d high(const Corners& p) { return max(p[0], max(p[1], p[2])); }

}  // namespace

FaceGrid::FaceGrid(const std::vector<Vec3d>& positions, const std::vector<Triangle>& triangles, double size)
    : positions_(positions), triangles_(triangles), size_(size) {
  std::size_t buckets = 1024;
  while (buckets < 2 * triangles.size()) buckets *= 2;
  heads_.assign(buckets, -1);
  nodes_.reserve(4 * triangles.size());
}

template <class Visit>
void FaceGrid::visit_cells(Vec3d lo, Vec3d hi, const Visit& visit) const {
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size_)); };
  for (std::int64_t i = cell(lo.x); i <= cell(hi.x); i++)
    for (std::int64_t j = cell(lo.y); j <= cell(hi.y); j++)
      for (std::int64_t k = cell(lo.z); k <= cell(hi.z); k++) {
        const auto hash = static_cast<std::uint64_t>(i * 73856093 + j * 19349663 + k * 83492791) * 0x9E3779B97F4A7C15ull;
        visit((hash >> 32) & (heads_.size() - 1));
      }
}

void FaceGrid::insert(std::uint32_t f) {
  const Triangle& t = triangles_[f];
  const Corners p = {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  visit_cells(low(p), high(p), [&](std::size_t bucket) {
    for (std::int32_t n = heads_[bucket]; n >= 0; n = nodes_[n].next)
      if (nodes_[n].face == f) return;
    nodes_.push_back({f, heads_[bucket]});
    heads_[bucket] = static_cast<std::int32_t>(nodes_.size() - 1);
  });
}

void FaceGrid::crossings(const Triangle& t, std::uint32_t vertex, Vec3d moved, const std::vector<std::uint32_t>& without,
                         std::vector<std::uint32_t>& found) const {
  const auto place = [&](std::uint32_t v) { return v == vertex ? moved : positions_[v]; };
  const Corners p = {place(t[0]), place(t[1]), place(t[2])};
  const Vec3d lo = low(p), hi = high(p);
  visit_cells(lo, hi, [&](std::size_t bucket) {
    for (std::int32_t n = heads_[bucket]; n >= 0; n = nodes_[n].next) {
      const std::uint32_t f = nodes_[n].face;
      const Triangle& u = triangles_[f];
      if (u[0] == u[1]) continue;
      const Corners q = {positions_[u[0]], positions_[u[1]], positions_[u[2]]};
      if (apart<&Vec3d::x>(q, lo, hi) || apart<&Vec3d::y>(q, lo, hi) || apart<&Vec3d::z>(q, lo, hi)) continue;
      if (std::find(without.begin(), without.end(), f) != without.end() || std::find(found.begin(), found.end(), f) != found.end()) continue;
      if (cross_each_other(t, u, p, q)) found.push_back(f);
    }
  });
}

std::vector<std::uint32_t> self_intersections(const MeshData& mesh) {
  double size = 0;
  for (const Triangle& t : mesh.triangles) {
    const Corners p = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    size += length(high(p) - low(p)) / static_cast<double>(mesh.triangles.size());
  }
  FaceGrid grid(mesh.positions, mesh.triangles, size);
  std::vector<bool> hit(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); f++) {
    std::vector<std::uint32_t> crossed;
    grid.crossings(mesh.triangles[f], ~0u, {}, {}, crossed);
    for (const std::uint32_t g : crossed) hit[f] = hit[g] = true;
    grid.insert(f);
  }
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < hit.size(); f++)
    if (hit[f]) faces.push_back(f);
  return faces;
}

}  // namespace stokes
