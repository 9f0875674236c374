// pbrt-v4 to our scene: its graphics state, and what its two files share. Internal to runtime/import.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "import/affine_json.h"
#include "import/pbrt_file.h"

namespace stokes {

/// Wavelengths in nm, and values.
using Curve = std::pair<std::vector<double>, std::vector<double>>;

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
    std::map<std::string, std::vector<PbrtParameter>> defaults;  // of Attribute, by its kind of directive
    bool at_start = true;  // transforms mean the shutter's opening, the one moment that we know
  };

  // pbrt_scene.cpp
  void collect_names(const std::vector<PbrtDirective>& directives);
  void apply(const PbrtDirective& d);
  bool apply_block(const PbrtDirective& d);
  bool apply_transform(const PbrtDirective& d);
  bool apply_option(const PbrtDirective& d);
  bool apply_attribute(const PbrtDirective& d);
  bool apply_defaults(const PbrtDirective& d);
  PbrtDirective with_defaults(PbrtDirective d) const;
  bool apply_light(const PbrtDirective& d);
  void apply_camera(const PbrtDirective& d);
  void finish_camera();
  std::string medium_named(const PbrtDirective& d, const std::string& name) const;

  // pbrt_shapes.cpp
  bool apply_object(const PbrtDirective& d);
  void count_surfaces(const PbrtDirective& d, std::size_t more);
  void apply_shape(const PbrtDirective& d);
  ImportJson shape_of(const PbrtDirective& d, const std::string& type);
  ImportJson mesh_of(const std::string& name, ImportedMesh mesh);
  ImportedMesh triangles_of(const PbrtDirective& d);
  void set_media(const PbrtDirective& d, ImportJson& surface);

  // pbrt_materials.cpp
  ImportJson material_of(const PbrtDirective& d, const std::string& type);
  ImportJson conductor_of(const PbrtDirective& d);
  ImportJson medium_of(const PbrtDirective& d);
  ImportJson spectrum_of(const PbrtDirective& d, const char* name, Role role, const ImportJson& fallback);
  ImportJson texture_of(const PbrtDirective& d);
  ImportJson as_curve(ImportJson j, const Curve& curve, const PbrtDirective& d, const PbrtParameter& p, Role role);
  ImportJson named_spectrum_of(const PbrtDirective& d, const PbrtParameter& p, Role role, const ImportJson& fallback);
  double alpha_of(const PbrtDirective& d);
  double plain_number(const PbrtDirective& d, const char* name, double fallback);

  void note(const PbrtDirective& d, const std::string& message) { out_.note(d.file, d.line, message); }
  void note_unused(const PbrtDirective& d);

  ImportTarget target_;
  std::string path_, folder_;  // of the scene; every file is named from there
  ImportedScene out_;
  State state_;
  std::vector<std::pair<State, bool>> stack_;  // and whether an AttributeBegin pushed it
  std::map<std::string, ImportJson> textures_;  // by "spectrum name" or "float name"
  std::set<std::string> materials_, media_;       // all names, which may be used before they are made
  std::set<std::string> made_materials_;
  std::set<std::tuple<std::string, int, std::string>> noted_;  // file, line and name of parameters
  std::set<std::string> left_out_;                // media that are none of ours
  std::map<std::string, Affine> coordinate_systems_;
  std::map<std::string, ImportJson> objects_;
  std::string object_;  // that is being defined; empty: none
  std::size_t surface_count_ = 0;
  std::string camera_medium_;
  std::optional<Affine> world_to_camera_;
  ImportJson camera_ = ImportJson::object();
  const PbrtDirective* camera_directive_ = nullptr;
  double fov_ = 90, width_ = 1280, height_ = 720;
};

}  // namespace stokes
