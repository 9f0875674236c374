// A scene on its way from another renderer's file to ours: the JSON, the meshes to be written beside it, and the list of what was not
// understood. Knows our format's words, neither of the others.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "input/text.h"

namespace stokes {

/// The file cannot be imported at all. what() is one line, `file:line: error: message`.
class ImportError : public std::runtime_error {
 public:
  ImportError(const std::string& file, int line, const std::string& message)
      : std::runtime_error(message_line(file + ":" + std::to_string(line) + ": error: " + message)) {}
};

/// Triangles as an OBJ file holds them: normals and uvs, where there are any, one a position.
struct ImportedMesh {
  std::vector<std::array<double, 3>> positions, normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::array<int, 3>> triangles;
};

/// The whole of a regular file, unpacked where it is packed by gzip. Throws std::runtime_error, OutOfMemory.
std::string read_text_file(const std::string& path);

/// The mesh as OBJ text.
std::string obj_text(const ImportedMesh& mesh);

/// Reads a PLY file (ascii, or binary of either byte order, also packed by gzip); polygons become fans. Throws std::runtime_error.
ImportedMesh read_ply(const std::string& path);
/// Reads an OBJ file: a position of its own for each combination of position, uv and normal. Throws std::runtime_error.
ImportedMesh read_obj_mesh(const std::string& path);

using ImportJson = nlohmann::ordered_json;

struct ImportedScene {
  ImportJson json = ImportJson::object();
  std::vector<std::pair<std::string, ImportedMesh>> meshes;  ///< by the name of the OBJ file, relative to the scene
  struct Note {
    std::string file;
    int line = 0;
    std::string message;
    std::string text() const { return message_line(file + ":" + std::to_string(line) + ": note: " + message); }
  };
  std::vector<Note> notes;

  void note(const std::string& file, int line, const std::string& message) { notes.push_back({file, line, message}); }
};

/// Where the scene will be written: names of files are made relative to it, meshes are named after it.
struct ImportTarget {
  std::string folder, stem;
  bool allow_outside = false;  ///< files may be read from anywhere, not only where a scene's files may lie
};

/// `path`, named in a file of `source_folder`, as a file of the target's folder would name it.
std::string relative_file(const ImportTarget& target, const std::string& source_folder, const std::string& path);
/// Throws std::runtime_error with the reason why a file may not be read by a scene of `scene_folder`: a regular one, where a scene's files may lie.
void require_readable(const ImportTarget& target, const std::string& scene_folder, const std::string& path);
/// The path of the file `name`, named in a file of `source_folder`, which may be read. Throws as require_readable.
std::string path_beside(const ImportTarget& target, const std::string& source_folder, const std::string& name);

/// What one file may ask for, as files that refer to themselves or to each other can ask for any amount. Surfaces: as many as a scene's JSON can hold.
constexpr int kDeepestImport = 100, kDeepestXml = 1000;
constexpr std::size_t kMostIncludes = 1000, kMostBlocks = 10'000, kMostMaterials = 50'000, kMostSurfaces = 300'000;

/// Whether an image stands somewhere in a material.
bool has_image(const ImportJson& material);

/// Where both others' films begin and end, in nm; and what is said of an index whose samples do not reach that far.
constexpr double kFilmBegin = 360, kFilmEnd = 780;
constexpr const char* kHeld = "an index of refraction keeps its last value beyond its samples here, and is 0 there";

/// A spectrum of ours times a number, in the simplest form.
ImportJson scaled(ImportJson spectrum, double factor);
/// "eta" and "k" of "Ag", "Al", "Au" or "Cu" from 400 to 700 nm, else null (rounded from Johnson and Christy 1972; Al: Rakic 1995).
ImportJson metal_of(const std::string& name);

/// Throw ImportError where the file is none of its kind; what has no counterpart becomes a note.
ImportedScene import_mitsuba(const std::string& path, const ImportTarget& target);
ImportedScene import_pbrt(const std::string& path, const ImportTarget& target);

}  // namespace stokes
