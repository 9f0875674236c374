// What is promised of any file that is imported: a scene that can be written and that our reader reads or refuses, or one line with its place.
#pragma once
#include "fuzz/checks.h"
#include "fuzz/scratch_file.h"
#include "import/imported_scene.h"
#include "scene/error.h"
#include "scene/read_scene.h"

namespace stokes::fuzz {

inline void check_import_line(const std::string& line, const std::string& kind) {
  const std::size_t at = line.find(": " + kind + ": ");
  if (at == std::string::npos || line.find_last_of(':', at - 1) == std::string::npos) finding("a line without its place or kind", line);
  if (std::atoi(line.c_str() + line.find_last_of(':', at - 1) + 1) < 1) finding("a line without its place", line);
  if (line.size() > 1100) finding("a very long line", line);
  for (const char c : line)
    if (static_cast<unsigned char>(c) < 0x20) finding("a control character in a line", line);
}

inline void check_imported_mesh(const ImportedMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  if ((!mesh.normals.empty() && mesh.normals.size() != n) || (!mesh.uvs.empty() && mesh.uvs.size() != n)) finding("a mesh", "with other numbers of vertices");
  if (mesh.triangles.empty()) finding("a mesh", "without triangles");
  for (const auto& t : mesh.triangles)
    for (const int v : t)
      if (v < 0 || static_cast<std::size_t>(v) >= n) finding("a mesh", "with an index out of range");
}

/// Imports the bytes as a file of this name by `import`, and reads what comes of it.
template <class Import>
void import_and_read(const char* name, const unsigned char* data, std::size_t size, const Import& import) {
  const std::string& path = scratch_file(name, data, size);
  try {
    const ImportedScene scene = import(path, ImportTarget{scratch_folder(), "a", false});
    for (const auto& [file, mesh] : scene.meshes) check_imported_mesh(mesh);
    for (const ImportedScene::Note& note : scene.notes) check_import_line(note.text(), "note");
    const std::string text = scene.json.dump();
    try {
      read_scene_text(text, "a.json", scratch_folder(), {}, {});
    } catch (const SceneError& error) {
      check_scene_error(error.what(), "a.json");
    }
  } catch (const ImportError& error) {
    check_import_line(error.what(), "error");
  }
}

}  // namespace stokes::fuzz
