// Mitsuba 3's XML to our scene: what its files share. Internal to runtime/import.
#pragma once
#include <optional>

#include "import/affine_json.h"
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
  void read_sensor(const Node& sensor);
  void read_film(const Node& film, ImportJson& camera);
  void read_integrator(const Node& integrator);
  void read_emitter(const Node& emitter);
  void read_shape(const Node& shape);
  ImportJson shape_of(const Node& shape, const Affine& to_world);
  ImportJson cube_of(const Affine& to_world) const;
  ImportJson mesh_of(const Node& shape, const Affine& to_world, bool ply);
  Affine transform_of(const Node& node, const char* name);
  double vertical_fov(const Node& sensor, double width, double height);

  // mitsuba_materials.cpp
  ImportJson material_of(const Node& bsdf);
  ImportJson conductor_of(const Node& bsdf, bool rough);
  ImportJson dielectric_of(const Node& bsdf, bool rough);
  ImportJson shape_material(const Node& shape, bool emits);
  double index_of(const Node& bsdf, const char* name, const char* fallback);
  double alpha_of(const Node& bsdf);
  void expect_one(const Node& bsdf, const char* name);
  ImportJson medium_of(const Node& medium);
  ImportJson shape_medium(const Node& shape, const char* side);
  ImportJson spectrum_of(const Node& node, Role role);
  ImportJson spectrum_child(const Node& node, const char* name, Role role, const ImportJson& fallback);
  ImportJson texture_of(const Node& texture);
  Node follow(const Node& reference) const;

  void note(const Node& node, const std::string& message) { out_.note(xml_.path(), xml_.line(node), message); }

  ImportTarget target_;
  XmlScene xml_;
  std::string folder_;
  ImportedScene out_;
  std::map<std::string, Node> by_id_;
  std::set<std::string> materials_, media_;  // names that the scene has by now
};

}  // namespace stokes
