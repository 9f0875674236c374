// pbrt-v4 to our scene: its graphics state, and what its two files share. Internal to runtime/import.
#pragma once
#include <map>
#include <optional>
#include <set>

#include "import/affine_json.h"
#include "import/pbrt_file.h"

namespace stokes {

class PbrtImport {
 public:
  PbrtImport(const std::string& path, ImportTarget target);
  ImportedScene run();

 private:
  enum class Role { Reflectance, Emission, Coefficient, Index };
  // What AttributeBegin saves.
  struct State {
    Affine transform;
    ImportJson material = {{"type", "lambertian"}, {"albedo", 0.5}};
    ImportJson emit;  // null: none
    std::string inside, outside;
    bool reverse = false;
  };

  // pbrt_scene.cpp
  void apply(const PbrtDirective& d);
  bool apply_transform(const PbrtDirective& d);
  bool apply_setting(const PbrtDirective& d);
  bool apply_light(const PbrtDirective& d);
  void apply_shape(const PbrtDirective& d);
  void finish_camera();
  ImportJson mesh_of(const PbrtDirective& d, const std::string& name, ImportedMesh mesh);
  ImportJson triangles_of(const PbrtDirective& d);

  // pbrt_materials.cpp
  ImportJson material_of(const PbrtDirective& d, const std::string& type);
  ImportJson conductor_of(const PbrtDirective& d);
  ImportJson medium_of(const PbrtDirective& d);
  ImportJson spectrum_of(const PbrtDirective& d, const char* name, Role role, const ImportJson& fallback);
  ImportJson texture_of(const PbrtDirective& d);
  double alpha_of(const PbrtDirective& d);

  void note(const PbrtDirective& d, const std::string& message) { out_.note(d.file, d.line, message); }
  void note_unused(const PbrtDirective& d);

  ImportTarget target_;
  std::string path_;
  ImportedScene out_;
  State state_;
  std::vector<std::pair<State, bool>> stack_;  // and whether an AttributeBegin pushed it
  std::map<std::string, ImportJson> textures_;
  std::set<std::string> materials_, media_;
  std::optional<Affine> world_to_camera_;
  ImportJson camera_ = ImportJson::object();
  double fov_ = 90, width_ = 1280, height_ = 720;
};

}  // namespace stokes
