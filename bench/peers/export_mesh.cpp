// Writes a procedural mesh as OBJ, without normals, so that every renderer sees the same flat triangles:
// bench_export_mesh NAME RESOLUTION OUT.obj [PARAMETER=VALUE ...]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "mesh/generate.h"

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_export_mesh head|hand RESOLUTION OUT.obj [PARAMETER=VALUE ...]\n");
    return 64;
  }
  stokes::GeneratorOptions options{.resolution = std::atof(argv[2]), .pose = {}, .parameters = {}};
  for (int i = 4; i < argc; i++) {
    const std::string text = argv[i];
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return std::fprintf(stderr, "%s: no PARAMETER=VALUE\n", argv[i]), 64;
    options.parameters.emplace_back(text.substr(0, equals), std::atof(text.c_str() + equals + 1));
  }
  const stokes::MeshData mesh = stokes::generate_mesh(argv[1], options);
  std::FILE* file = std::fopen(argv[3], "w");
  if (!file) return std::perror(argv[3]), 5;
  for (const stokes::Vec3d& p : mesh.positions) std::fprintf(file, "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
  for (const auto& t : mesh.triangles) std::fprintf(file, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return std::fclose(file) == 0 ? 0 : 5;
}
