// Mitsuba's shapes, what hangs on them, and instances.
#include <cstring>
#include <filesystem>

#include "import/mitsuba_import.h"
#include "input/limits.h"

namespace stokes {
namespace {

bool mirrors(const Affine& a) { return a.determinant() < 0; }

void toggle_flip(ImportJson& common) {
  if (!common.erase("flip")) common["flip"] = true;
}

}  // namespace

bool MitsubaImport::is_textured(const ImportJson& material) const {
  if (!material.is_string()) return has_image(material);
  for (const ImportJson& m : out_.json["materials"])
    if (m["name"] == material) return has_image(m);
  return false;
}

// The faces of [-1, 1]^3, each a quad that looks outwards and has Mitsuba's texture coordinates.
ImportJson MitsubaImport::cube_of(const Affine& to_world) const {
  ImportJson group = {{"type", "group"}, {"children", ImportJson::array()}};
  if (const ImportJson t = transform_json(to_world); !t.is_null()) group["transform"] = t;
  const std::array<std::array<int, 3>, 3> frames[6] = {{{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}}, {{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                       {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},   {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}},
                                                       {{{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}}}, {{{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}}};
  for (const auto& [x, y, z] : frames)
    group["children"].push_back({{"type", "quad"}, {"size", 2}, {"transform", {{"o", z}, {"x", x}, {"y", y}, {"z", z}}}});
  return group;
}

// A mesh as it is in Mitsuba: smooth where the file has no normals, faceted on demand, and with the first row of an image at v = 0. The OBJ
// file itself is named where it is all that already; else a copy is written.
ImportJson MitsubaImport::mesh_of(const Node& shape, const Affine& to_world, ImportJson& common) {
  const bool ply = std::strcmp(shape.attribute("type").value(), "ply") == 0;
  const Node filename = xml_.child(shape, "filename");
  if (!filename) xml_.fail(shape, "the mesh names no file");
  const std::string value = xml_.attribute(filename, "value"), file = xml_.file_named(filename, value);
  ImportedMesh mesh;
  xml_.require_readable(filename, file);
  try {
    mesh = ply ? read_ply(file) : read_obj_mesh(file);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {
    xml_.fail(filename, value + " cannot be read as " + (ply ? "PLY: " : "OBJ: ") + error.what());
  }
  const bool facets = xml_.number(shape, "face_normals", 0) != 0, flips_images = xml_.number(shape, "flip_tex_coords", ply ? 0 : 1) != 0;
  bool changed = ply;
  if (facets || mesh.normals.empty()) {
    if (mirrors(to_world)) toggle_flip(common);
    changed |= !facets || !mesh.normals.empty();
    mesh.normals.clear();
    if (!facets) give_smooth_normals(mesh, to_world);
  }
  if (!flips_images && !mesh.uvs.empty()) {
    for (auto& uv : mesh.uvs) uv[1] = 1 - uv[1];
    changed = true;
  }
  ImportJson j = {{"type", "mesh"}};
  if (changed) {
    j["filename"] =
        target_.stem + "_meshes/" + std::filesystem::path(value).stem().string() + "_" + std::to_string(out_.meshes.size()) + ".obj";
    out_.meshes.emplace_back(j["filename"], std::move(mesh));
  } else {
    j["filename"] = relative_file(target_, "", file);
  }
  if (const ImportJson t = transform_json(to_world); !t.is_null()) j["transform"] = t;
  return j;
}

Vec3d MitsubaImport::center_of(const Node& center) {
  if (!center) return {};
  std::vector<double> v;
  if (center.attribute("value"))
    v = xml_.numbers(center, xml_.attribute(center, "value"));
  else
    for (const char* key : {"x", "y", "z"}) {
      const std::vector<double> one = center.attribute(key) ? xml_.numbers(center, xml_.attribute(center, key)) : std::vector<double>{0};
      v.insert(v.end(), one.begin(), one.end());
    }
  if (v.size() != 3) xml_.fail(center, "expected three numbers");
  return {v[0], v[1], v[2]};
}

ImportJson MitsubaImport::shape_of(const Node& shape, const Affine& to_world, bool textured, ImportJson& common) {
  const std::string type = shape.attribute("type").value();
  if (type == "cube") return cube_of(to_world);
  if (type == "obj" || type == "ply") return mesh_of(shape, to_world, common);
  ImportJson j;
  Affine place = to_world;
  if (type == "sphere") {
    j = {{"type", "sphere"}, {"radius", xml_.number(shape, "radius", 1)}};
    place = place * translation_of(center_of(xml_.child(shape, "center")));
    if (mirrors(to_world)) toggle_flip(common);  // which turns spheres inside out there
  } else if (type == "rectangle") {
    j = {{"type", "quad"}, {"size", 2}};
    // The first row of an image is at v = 0 there, at the top here; a mirrored quad keeps its normal.
    if (textured) place = place * scaling_of({1, -1, 1});
  } else {
    return nullptr;
  }
  if (const ImportJson t = transform_json(place); !t.is_null()) j["transform"] = t;
  return j;
}

// An area emitter, as a child or by its id. One whose radiance is an image is a material here.
void MitsubaImport::read_lamp(const Node& shape, ImportJson& common) {
  ImportJson emit;
  for (const Node& c : shape.children()) {
    if (c.type() != pugi::node_element || (std::strcmp(c.name(), "emitter") != 0 && std::strcmp(c.name(), "ref") != 0)) continue;
    const Node emitter = follow(c);
    if (std::strcmp(emitter.name(), "emitter") != 0 || std::strcmp(emitter.attribute("type").value(), "area") != 0) continue;
    xml_.use(c);
    xml_.use(emitter);
    emit = spectrum_child(emitter, "radiance", Role::Emission, 1.0);
  }
  common["material"] = shape_material(shape, !emit.is_null());
  if (emit.is_null()) return;
  if (!has_image(emit)) {
    common["emit"] = emit;
    return;
  }
  if (common["material"] != ImportJson{{"type", "lambertian"}, {"albedo", 0.0}})
    note(shape, "a lamp by an image reflects nothing here: its BSDF was left out");
  note(shape, "a lamp by an image has the white of D65 here, and of equal energy there");
  common["material"] = {{"type", "diffuse_light"}, {"emit", emit}};
}

// The surface of a shape; null when it was left out.
ImportJson MitsubaImport::surface_of(const Node& shape) {
  xml_.use(shape);
  if (std::strcmp(shape.attribute("type").value(), "instance") == 0) return instance_of(shape);
  count_surfaces(shape, 1);
  ImportJson common = ImportJson::object();
  common[kPlaceKey] = place_of(xml_.path_of(shape), xml_.line(shape));
  if (shape.attribute("id")) common["name"] = xml_.attribute(shape, "id");
  if (xml_.number(shape, "flip_normals", 0) != 0) common["flip"] = true;
  read_lamp(shape, common);
  ImportJson surface = shape_of(shape, transform_of(shape, "to_world"), is_textured(common["material"]), common);
  if (surface.is_null()) {
    note(shape, "a shape of type \"" + std::string(shape.attribute("type").value()) + "\" has no counterpart here and was left out");
    for (const Node& c : shape.children()) xml_.use(c);
    return surface;
  }
  if (const ImportJson inside = shape_medium(shape, "interior"); !inside.is_null()) common["inside"] = inside;
  if (const ImportJson outside = shape_medium(shape, "exterior"); !outside.is_null()) common["outside"] = outside;
  if (surface["type"] == "group")
    for (ImportJson& face : surface["children"]) face.update(common);
  else
    surface.update(common);
  return surface;
}

void MitsubaImport::read_group(const Node& shape) {
  xml_.use(shape);
  const std::string id = xml_.attribute(shape, "id");
  ImportJson& group = groups_[id] = ImportJson::array();
  const std::size_t before = surface_count_;
  for (const Node& child : shape.children("shape"))
    if (ImportJson surface = surface_of(child); !surface.is_null()) group.push_back(surface);
  group_sizes_[id] = surface_count_ - before;
}

// Instances of groups of instances would multiply without end.
void MitsubaImport::count_surfaces(const Node& shape, std::size_t more) {
  surface_count_ += more;
  if (surface_count_ > kMostSurfaces) xml_.fail(shape, "more than " + std::to_string(kMostSurfaces) + " surfaces, those of instances included");
}

ImportJson MitsubaImport::instance_of(const Node& shape) {
  for (const Node& c : shape.children("ref")) {
    xml_.use(c);
    const auto group = groups_.find(xml_.attribute(c, "id"));
    if (group == groups_.end()) xml_.fail(c, "no shape group before this has the id \"" + xml_.attribute(c, "id") + "\"");
    if (group->second.empty()) return nullptr;
    count_surfaces(shape, group_sizes_[group->first]);
    ImportJson j = {{"type", "group"}, {"children", group->second}};
    if (const ImportJson t = transform_json(transform_of(shape, "to_world")); !t.is_null()) j["transform"] = t;
    return j;
  }
  xml_.fail(shape, "the instance names no shape group");
}

void MitsubaImport::read_shape(const Node& shape) {
  if (std::strcmp(shape.attribute("type").value(), "shapegroup") == 0) return read_group(shape);
  if (const ImportJson surface = surface_of(shape); !surface.is_null()) out_.json["surfaces"].push_back(surface);
}

}  // namespace stokes
