// Places and faces of shells against the exact distance.
#include "mesh/shell_measure.h"

#include "mesh/in_parallel.h"
#include "mesh/self_intersection.h"

namespace stokes {

namespace {
constexpr double kBend = 0.02;  // of the distance: an edge that rises less over either end's plane is taken as lying on the level
constexpr double kNear = 1.05;  // of the distance: most places asked for are no further from the mesh
}

ShellMeasure::Place ShellMeasure::at(Vec3d p) const {
  Vec3d nearest;
  Place place;
  place.s = distance_(p, &nearest, nullptr, kNear * std::abs(d_));
  place.off = std::abs(place.s / d_ - 1);
  place.gradient = place.s != 0 ? (p - nearest) / place.s : Vec3d{};
  return place;
}

ShellMeasure::Face ShellMeasure::face(const Corner& a, const Corner& b, const Corner& c, bool all) const {
  const Vec3d n = cross(b.position - a.position, c.position - a.position);
  const double longest = std::max({length_squared(b.position - a.position), length_squared(c.position - b.position), length_squared(a.position - c.position)});
  const Place middle = at((a.position + b.position + c.position) / 3);
  const double size = length(n);
  Face face;
  face.facing = size > kThin * longest ? dot(n, middle.gradient) / size : -1;
  face.off = middle.off;
  const auto edge = [&](const Corner& p, const Corner& q) {
    const Vec3d along = q.position - p.position;
    const double bend = kBend * std::abs(d_);
    if (!all && std::abs(dot(along, p.gradient)) < bend && std::abs(dot(along, q.gradient)) < bend) return;
    face.off = std::max(face.off, at((p.position + q.position) * 0.5).off);
  };
  edge(a, b), edge(b, c), edge(c, a);
  return face;
}

Vec3d ShellMeasure::project(Vec3d p) const {
  for (int i = 0; i < 3; i++) {
    const Place place = at(p);
    if (place.off < 1e-4) break;
    p += place.gradient * (d_ - place.s);
  }
  return p;
}

bool worse(const ShellFaults& a, const ShellFaults& b) {
  const auto grave = [](const ShellFaults& f) { return f.flipped + f.crossed + f.off_vertices; };
  return grave(a) != grave(b) ? grave(a) > grave(b) : a.off_faces > b.off_faces;
}

ShellFaults shell_faults(const MeshData& shell, const MeshDistance& distance, double d) {
  const ShellMeasure measure(distance, d);
  std::vector<ShellMeasure::Corner> corners(shell.positions.size());
  std::vector<char> off(shell.positions.size()), off_face(shell.triangles.size()), flipped(shell.triangles.size());
  in_parallel(corners.size(), [&](std::size_t v) {
    const ShellMeasure::Place place = measure.at(shell.positions[v]);
    corners[v] = {shell.positions[v], place.gradient};
    off[v] = place.off > ShellMeasure::kTolerance;
  });
  in_parallel(shell.triangles.size(), [&](std::size_t f) {
    const auto& t = shell.triangles[f];
    const ShellMeasure::Face face = measure.face(corners[t[0]], corners[t[1]], corners[t[2]]);
    flipped[f] = face.facing <= 0;
    off_face[f] = face.off > ShellMeasure::kTolerance;
  });
  const auto count = [](const std::vector<char>& flags) { return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1)); };
  return {count(flipped), self_intersections(shell).size(), count(off), count(off_face)};
}

}  // namespace stokes
