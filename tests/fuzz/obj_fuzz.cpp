// Fuzzes the import of OBJ files: any bytes give a mesh whose indices and numbers are sound, or a scene error.
#include <cmath>

#include "fuzz/checks.h"
#include "fuzz/lone_node.h"
#include "fuzz/scratch_file.h"
#include "scene/mesh_reader.h"

namespace {

using stokes::fuzz::finding;

void check_raw(const stokes::RawMesh& mesh) {
  const auto check = [](int index, std::size_t count, bool needed) {
    if (index < (needed ? 0 : -1) || index >= static_cast<int>(count)) finding("a face", "with an index out of range");
  };
  if (mesh.faces.empty()) finding("a mesh", "without faces");
  for (const stokes::RawMesh::Face& face : mesh.faces) {
    if (face.material < 0 || face.material >= static_cast<int>(mesh.materials.size())) finding("a face", "of no material");
    for (const stokes::RawMesh::Corner& c : face.corners) {
      check(c.position, mesh.positions.size(), true);
      check(c.normal, mesh.normals.size(), false);
      check(c.uv, mesh.uvs.size(), false);
    }
  }
}

void check_mesh(const stokes::MeshData& mesh) {
  const std::size_t n = mesh.positions.size();
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
  static const fuzz::LoneNode filename(R"("a.obj")");
  const std::string& path = fuzz::scratch_file("a.obj", data, size);
  SceneDescription scene;
  try {
    // As of any mesh of a scene: read, faces without area dropped, divided by material.
    RawMesh raw = read_obj(filename.context(scene), filename.node(), path);
    check_raw(raw);
    const std::size_t total = raw.faces.size(), dropped = drop_degenerate_faces(raw);
    if (raw.faces.size() + dropped != total) finding("dropped faces", "that are miscounted");
    std::size_t kept = 0;
    for (const MeshData& mesh : extract_materials(raw)) {
      check_mesh(mesh);
      kept += mesh.triangles.size();
    }
    if (kept != raw.faces.size()) finding("a mesh", "that lost triangles when it was divided");
  } catch (const SceneError& error) {
    fuzz::check_scene_error(error.what(), "scene.json");
  }
  return 0;
}
