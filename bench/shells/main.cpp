// Measures shells by distance field: `shells MESH D...`, where MESH is head:RESOLUTION, hand:RESOLUTION[:POSE] or an OBJ file. One line a shell: its
// faces, those that look against the distance's gradient, the distance's deviation at vertices and at faces' middles, crossings, user seconds.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "mesh/generate.h"
#include "mesh/mesh_distance.h"
#include "mesh/offset.h"
#include "mesh/self_intersection.h"

namespace {

using namespace stokes;

double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

MeshData read_triangles(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  MeshData mesh;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind, corner;
    words >> kind;
    Vec3d p;
    if (kind == "v" && words >> p.x >> p.y >> p.z) mesh.positions.push_back(p);
    if (kind != "f") continue;
    std::vector<std::uint32_t> corners;
    while (words >> corner) corners.push_back(static_cast<std::uint32_t>(std::stoul(corner) - 1));
    for (std::size_t i = 2; i < corners.size(); i++) mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return mesh;
}

MeshData mesh_called(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return read_triangles(name);
  const std::size_t pose = name.find(':', colon + 1);
  GeneratorOptions options;
  options.resolution = std::stod(name.substr(colon + 1));
  if (pose != std::string::npos) options.pose = name.substr(pose + 1);
  return generate_mesh(name.substr(0, colon), options);
}

struct Deviations {
  std::vector<double> all;
  void print(const char* what) {
    std::sort(all.begin(), all.end());
    const auto over = all.end() - std::upper_bound(all.begin(), all.end(), 0.05);
    std::printf("  %s: max %.2f%% p99.99 %.2f%% over %td", what, 100 * all.back(),
                100 * all[static_cast<std::size_t>(0.9999 * static_cast<double>(all.size() - 1))], over);
  }
};

void measure(const MeshData& mesh, const MeshDistance& distance, double d) {
  const double start = user_seconds();
  std::size_t faulty = 0;
  const MeshData shell = offset_by_distance_field(mesh, d, 0, &faulty);
  const double seconds = user_seconds() - start;
  Deviations vertices, middles, edges;
  for (const Vec3d& p : shell.positions) vertices.all.push_back(std::abs(distance(p) / d - 1));
  std::size_t flipped = 0, against_parent = 0;
  for (std::size_t f = 0; f < shell.triangles.size(); f++) {
    const auto& t = shell.triangles[f];
    const Vec3d a = shell.positions[t[0]], b = shell.positions[t[1]], c = shell.positions[t[2]], middle = (a + b + c) / 3, n = cross(b - a, c - a);
    Vec3d nearest;
    std::uint32_t parent;
    const double s = distance(middle, &nearest, &parent);
    flipped += !(dot(n, middle - nearest) * s > 0);
    const auto& u = mesh.triangles[parent];
    against_parent += dot(n, cross(mesh.positions[u[1]] - mesh.positions[u[0]], mesh.positions[u[2]] - mesh.positions[u[0]])) <= 0;
    middles.all.push_back(std::abs(s / d - 1));
    for (int i = 0; i < 3; i++)
      if (t[i] < t[(i + 1) % 3]) edges.all.push_back(std::abs(distance((shell.positions[t[i]] + shell.positions[t[(i + 1) % 3]]) * 0.5) / d - 1));
  }
  std::printf("%+.2f: %7zu faces, %zu flipped, %zu against the nearest face, %zu crossing", d, shell.triangles.size(), flipped, against_parent,
              self_intersections(shell).size());
  vertices.print("vertices");
  middles.print("middles");
  edges.print("edges");
  std::printf("  closed %d  own count of faults %zu  %.2f s\n", mesh_topology(shell).watertight(), faulty, seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) throw std::runtime_error("usage: shells MESH D...");
  const MeshData mesh = mesh_called(argv[1]);
  const MeshDistance distance(mesh);
  std::printf("%s: %zu faces\n", argv[1], mesh.triangles.size());
  for (int i = 2; i < argc; i++) measure(mesh, distance, std::stod(argv[i]));
} catch (const std::exception& error) {
  std::fprintf(stderr, "shells: %s\n", error.what());
  return 1;
}
