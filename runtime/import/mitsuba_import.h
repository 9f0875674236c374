// Mitsuba 3's XML to our scene: what its files share. Internal to runtime/import.
#pragma once
#include <optional>

#include "import/affine_json.h"
#include "import/media_around.h"
#include "import/xml_scene.h"

namespace stokes {

class MitsubaImport {
 public:
  MitsubaImport(const std::string& path, ImportTarget target);
  ImportedScene run();

 private:
  using Node = pugi::xml_node;
  enum class Role { Reflectance, Emission, Coefficient, Index };

  // mitsuba_scene.cpp
  void read_named();
  void read_sensor(const Node& sensor);
  void read_film(const Node& film, ImportJson& camera);
  void read_integrator(const Node& integrator);
  void read_emitter(const Node& emitter);
  Affine transform_of(const Node& node, const char* name);
  Affine step_of(const Node& step);
  double vertical_fov(const Node& sensor, double width, double height);

  // mitsuba_shapes.cpp
  void read_shape(const Node& shape);
  ImportJson surface_of(const Node& shape);
  ImportJson shape_of(const Node& shape, const Affine& to_world, bool textured, ImportJson& common);
  ImportJson cube_of(const Affine& to_world) const;
  ImportJson mesh_of(const Node& shape, const Affine& to_world, ImportJson& common);
  ImportJson instance_of(const Node& shape);
  void read_group(const Node& shape);
  void count_surfaces(const Node& shape, std::size_t more);
  void read_lamp(const Node& shape, ImportJson& common);
  Vec3d center_of(const Node& center);
  bool is_textured(const ImportJson& material) const;

  // mitsuba_materials.cpp
  ImportJson material_of(const Node& bsdf);
  ImportJson inner_material(const Node& bsdf);
  ImportJson conductor_of(const Node& bsdf, bool rough);
  ImportJson dielectric_of(const Node& bsdf, bool rough);
  ImportJson other_material_of(const Node& bsdf, const std::string& type);
  ImportJson shape_material(const Node& shape, bool emits);
  double index_of(const Node& bsdf, const char* name, const char* fallback);
  double alpha_of(const Node& bsdf);
  void expect_one(const Node& bsdf, const char* name);
  ImportJson medium_of(const Node& medium);
  ImportJson shape_medium(const Node& shape, const char* side);

  // mitsuba_spectra.cpp
  ImportJson spectrum_of(const Node& node, Role role);
  ImportJson rgb_of(const Node& node);
  ImportJson listed_spectrum_of(const Node& node, Role role);
  ImportJson sampled_of(const Node& node, const std::vector<double>& wavelengths, const std::vector<double>& values, Role role);
  ImportJson spectrum_child(const Node& node, const char* name, Role role, const ImportJson& fallback);
  ImportJson texture_of(const Node& texture);
  std::string existing_file(const Node& node, const std::string& path) const;
  Node follow(const Node& reference) const;

  void note(const Node& node, const std::string& message) { out_.note(xml_.path_of(node), xml_.line(node), message); }

  ImportTarget target_;
  XmlScene xml_;
  ImportedScene out_;
  std::set<std::string> materials_, media_;   // names that the scene has by now
  std::map<std::string, ImportJson> groups_;  // surfaces, by the shape group's id
  std::string camera_medium_;
  int material_depth_ = 0;  // of BSDFs in BSDFs
  std::size_t material_count_ = 0, surface_count_ = 0;
  std::map<std::string, std::size_t> group_sizes_;  // in surfaces
};

}  // namespace stokes
