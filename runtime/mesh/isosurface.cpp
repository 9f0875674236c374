// Marching cubes with a case table that is derived, not typed: the loops of each of the 256 corner patterns are traced over the
// cube's faces. (Lorensen & Cline 1987; the consistent treatment of ambiguous faces as in Bloomenthal 1994.)
#include "mesh/isosurface.h"

#include <map>
#include <unordered_map>

#include "mesh/in_parallel.h"
#include "mesh/self_intersection.h"

namespace stokes {
namespace {

// Corner c stands at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e joins kEdge[e][0] and kEdge[e][1], the first with the smaller coordinate.
constexpr int kEdge[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
// The corners of each face, counter-clockwise seen from outside the cube.
constexpr int kFace[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; e++)
    if ((kEdge[e][0] == a && kEdge[e][1] == b) || (kEdge[e][0] == b && kEdge[e][1] == a)) return e;
  return -1;
}

bool share_a_face(int e, int f) {
  for (const auto& face : kFace) {
    auto on = [&](int c) { return c == face[0] || c == face[1] || c == face[2] || c == face[3]; };
    if (on(kEdge[e][0]) && on(kEdge[e][1]) && on(kEdge[f][0]) && on(kEdge[f][1])) return true;
  }
  return false;
}

struct Polygon {
  std::vector<int> edges;  // cube edges whose crossings are its corners, counter-clockwise from outside
  int pivot = -1;          // fan from here, or -1: fan from the centroid
};

// Going round a face, the surface's segment joins the edge where we leave the inside and the edge where we last entered it; so an
// inside corner always keeps its own segment on an ambiguous face. Followed from where we enter, the loops turn counter-clockwise
// seen from outside.
std::vector<Polygon> trace_loops(unsigned inside) {
  int next[12];
  std::fill(next, next + 12, -1);
  for (const auto& face : kFace)
    for (int s = 0; s < 4; s++) {
      const int a = face[s], b = face[(s + 1) % 4];
      if (!((inside >> a) & 1) || ((inside >> b) & 1)) continue;  // a inside, b outside: leaving
      int t = s;                                                   // walk back to where we entered
      while ((inside >> face[(t + 3) % 4]) & 1) t = (t + 3) % 4;
      next[edge_between(face[(t + 3) % 4], face[t])] = edge_between(a, b);
    }
  std::vector<Polygon> polygons;
  bool used[12] = {};
  for (int e = 0; e < 12; e++) {
    if (next[e] < 0 || used[e]) continue;
    Polygon p;
    for (int f = e; !used[f]; f = next[f]) used[f] = true, p.edges.push_back(f);
    // A diagonal inside a cube's face could meet the neighbour's; choose a fan that has none.
    const int n = static_cast<int>(p.edges.size());
    for (int c = 0; c < n && p.pivot < 0; c++) {
      bool clean = true;
      for (int k = 2; k + 1 < n && clean; k++) clean = !share_a_face(p.edges[c], p.edges[(c + k) % n]);
      if (clean) p.pivot = c;
    }
    polygons.push_back(p);
  }
  return polygons;
}

const std::vector<std::vector<Polygon>>& case_table() {
  static const std::vector<std::vector<Polygon>> table = [] {
    std::vector<std::vector<Polygon>> t(256);
    for (unsigned c = 0; c < 256; c++) t[c] = trace_loops(c);
    return t;
  }();
  return table;
}

constexpr int kFewSteps = 2, kManySteps = 12;  // enough for a smooth field; for one with kinks
constexpr double kOnLevel = 1e-4;              // of the edge's length

// Where the field crosses the level on the segment a-b, by some steps of regula falsi from the linear guess.
Vec3d crossing(Vec3d a, Vec3d b, double fa, double fb, double level, const Field* field, int steps) {
  double t0 = 0, t1 = 1, t = (level - fa) / (fb - fa);
  if (field)
    for (int i = 0; i < steps; i++) {
      const double f = (*field)(a + (b - a) * t);
      if ((f < level) == (fa < level)) t0 = t, fa = f;
      else t1 = t, fb = f;
      if (fa == fb || (steps > kFewSteps && std::abs(f - level) < kOnLevel * length(b - a))) break;
      t = t0 + (t1 - t0) * std::clamp((level - fa) / (fb - fa), 0.05, 0.95);
    }
  return a + (b - a) * std::clamp(t, 1e-3, 1 - 1e-3);  // never onto a corner: no triangle may collapse
}

Vec3d gradient(const Field& f, Vec3d p, double h) {
  return {f({p.x + h, p.y, p.z}) - f({p.x - h, p.y, p.z}), f({p.x, p.y + h, p.z}) - f({p.x, p.y - h, p.z}),
          f({p.x, p.y, p.z + h}) - f({p.x, p.y, p.z - h})};
}

// Evens out the triangles: marching cubes leaves slivers wherever the surface passes close to a corner of the grid. Each vertex slides along
// the surface towards the middle of its neighbours and returns to the level by a secant step.
void relax(MeshData& mesh, const Field& field, double level, double step) {
  constexpr int kRounds = 3;
  const std::size_t count = mesh.positions.size();
  for (int round = 0; round < kRounds; round++) {
    std::vector<Vec3d> normals(count), middles(count);
    std::vector<int> neighbours(count);
    for (const auto& t : mesh.triangles) {
      const Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]], n = cross(b - a, c - a);
      for (int s = 0; s < 3; s++) {
        normals[t[s]] += n;
        middles[t[s]] += mesh.positions[t[(s + 1) % 3]] + mesh.positions[t[(s + 2) % 3]];
        neighbours[t[s]] += 2;
      }
    }
    in_parallel(count, [&](std::size_t i) {
      if (!(length(normals[i]) > 0)) return;
      const Vec3d n = normalize(normals[i]), to_middle = middles[i] / neighbours[i] - mesh.positions[i];
      Vec3d p = mesh.positions[i] + (to_middle - n * dot(n, to_middle)) * 0.7;
      const double h = 0.1 * step, f = field(p), slope = (field(p + n * h) - f) / h;
      if (slope > 0.3) p += n * std::clamp((level - f) / slope, -0.5 * step, 0.5 * step);
      mesh.positions[i] = p;
    });
  }
}

// Where evened faces pass through one another, which they do where the field is thinner than the grid, their vertices return to where they
// were cut: there every face stays in its own cube.
void take_back(MeshData& mesh, const std::vector<Vec3d>& cut) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const std::uint32_t f : self_intersections(mesh))
      for (const std::uint32_t v : mesh.triangles[f]) {
        moved |= length_squared(mesh.positions[v] - cut[v]) > 0;
        mesh.positions[v] = cut[v];
      }
  }
}

}  // namespace

namespace {

// Where vertices are to stand, before any is computed: on an edge of the grid, or in the middle of other vertices.
struct Cut {
  std::array<int, 3> a, b;             // the edge's corners, as steps of the grid
  std::vector<std::uint32_t> corners;  // of a middle
};

// The triangles that cut all cells, with a cut for each vertex.
std::vector<Cut> cut_cells(const Grid& g, double level, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Cut> cuts;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_edge;
  const auto corner = [](int i, int j, int k, int c) { return std::array<int, 3>{i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1)}; };
  const auto vertex = [&](int i, int j, int k, int e) {
    const auto a = corner(i, j, k, kEdge[e][0]), b = corner(i, j, k, kEdge[e][1]);
    const std::uint64_t key = g.index(a[0], a[1], a[2]) * 3 + static_cast<std::uint64_t>(e / 4);
    const auto [it, fresh] = vertex_of_edge.try_emplace(key, static_cast<std::uint32_t>(cuts.size()));
    if (fresh) cuts.push_back({a, b, {}});
    return it->second;
  };
  for (int k = 0; k + 1 < g.nz; k++)
    for (int j = 0; j + 1 < g.ny; j++)
      for (int i = 0; i + 1 < g.nx; i++) {
        unsigned inside = 0;
        for (int c = 0; c < 8; c++) {
          const auto q = corner(i, j, k, c);
          inside |= static_cast<unsigned>(g.at(q[0], q[1], q[2]) < level) << c;
        }
        if (inside == 0 || inside == 255) continue;
        for (const Polygon& p : case_table()[inside]) {
          const std::size_t n = p.edges.size();
          std::vector<std::uint32_t> v(n);
          for (std::size_t s = 0; s < n; s++) v[s] = vertex(i, j, k, p.edges[s]);
          if (p.pivot >= 0) {
            for (std::size_t s = 1; s + 1 < n; s++) triangles.push_back({v[p.pivot], v[(p.pivot + s) % n], v[(p.pivot + s + 1) % n]});
          } else {
            const auto center = static_cast<std::uint32_t>(cuts.size());
            cuts.push_back({{}, {}, v});
            for (std::size_t s = 0; s < n; s++) triangles.push_back({center, v[s], v[(s + 1) % n]});
          }
        }
      }
  return cuts;
}

}  // namespace

MeshData isosurface(const Grid& g, double level, const Field* refine, bool even) {
  MeshData mesh;
  const std::vector<Cut> cuts = cut_cells(g, level, mesh.triangles);
  mesh.positions.resize(cuts.size());
  in_parallel(cuts.size(), [&](std::size_t i) {
    const auto& [a, b, corners] = cuts[i];
    if (corners.empty())
      mesh.positions[i] = crossing(g.point(a[0], a[1], a[2]), g.point(b[0], b[1], b[2]), g.at(a[0], a[1], a[2]), g.at(b[0], b[1], b[2]), level, refine,
                                   even ? kFewSteps : kManySteps);
  });
  for (std::size_t i = 0; i < cuts.size(); i++)
    for (const std::uint32_t v : cuts[i].corners) mesh.positions[i] += mesh.positions[v] / static_cast<double>(cuts[i].corners.size());
  if (!refine || !even) return mesh;
  const std::vector<Vec3d> cut = mesh.positions;
  relax(mesh, *refine, level, g.step);
  take_back(mesh, cut);
  mesh.normals.resize(mesh.positions.size());
  in_parallel(mesh.positions.size(), [&](std::size_t i) {
    const Vec3d n = gradient(*refine, mesh.positions[i], 0.25 * g.step);
    mesh.normals[i] = length(n) > 0 ? normalize(n) : Vec3d{0, 1, 0};
  });
  return mesh;
}

MeshTopology mesh_topology(const MeshData& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges;  // count per direction
  for (const auto& t : mesh.triangles)
    for (int s = 0; s < 3; s++) {
      const std::uint32_t a = t[s], b = t[(s + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1]++;
    }
  MeshTopology topology;
  for (const auto& [edge, count] : edges) {
    if (count[0] + count[1] == 1) topology.boundary_edges++;
    else if (count[0] != 1 || count[1] != 1) topology.nonmanifold_edges++;
  }
  return topology;
}

}  // namespace stokes
