// Fuzzes the import of OBJ files: any bytes give a mesh whose indices and numbers are sound, or a scene error.
#include <cmath>

#include "fuzz/checks.h"
#include "fuzz/scratch_file.h"
#include "scene/read_scene.h"

namespace {

void check_mesh(const stokes::MeshData& mesh) {
  using stokes::fuzz::finding;
  const std::size_t n = mesh.positions.size();
  if (mesh.triangles.empty()) finding("a mesh", "without triangles");
  if ((!mesh.normals.empty() && mesh.normals.size() != n) || (!mesh.uvs.empty() && mesh.uvs.size() != n)) finding("a mesh", "with other numbers of vertices");
  for (const auto& t : mesh.triangles)
    for (const auto v : t)
      if (v >= n) finding("a mesh", "with an index out of range");
  for (const stokes::Vec3d& p : mesh.positions)
    if (!stokes::is_finite(p)) finding("a mesh", "with a position that is not finite");
  for (const stokes::Vec3d& p : mesh.normals)
    if (!stokes::is_finite(p)) finding("a mesh", "with a normal that is not finite");
  for (const auto& uv : mesh.uvs)
    if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) finding("a mesh", "with a uv that is not finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  static const std::string scene =
      R"({"camera": {}, "materials": [{"type": "metal", "name": "own"}], "surfaces": [{"type": "mesh", "filename": "a.obj", "material": "own"}]})";
  fuzz::scratch_file("a.obj", data, size);
  try {
    const SceneDescription read = read_scene_text(scene, "scene.json", fuzz::scratch_folder());
    for (const SurfaceDescription& s : read.surfaces) check_mesh(*s.mesh);
  } catch (const SceneError& error) {
    fuzz::check_scene_error(error.what(), "scene.json");
  }
  return 0;
}
