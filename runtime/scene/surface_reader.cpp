// The types of surfaces, one function each.
#include "scene/surface_reader.h"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "mesh/generate.h"
#include "scene/material_reader.h"
#include "scene/medium_reader.h"
#include "scene/mesh_reader.h"
#include "scene/skin_reader.h"
#include "scene/spectrum_reader.h"
#include "scene/transform_reader.h"

namespace stokes {
namespace {

const std::vector<std::string> kTypes = {"quad", "sphere", "triangle", "mesh", "group"};

JsonObject surface_object(const JsonNode& node, const std::string& what, std::vector<std::string> keys) {
  for (const char* key : {"type", "name", "transform", "material", "outside", "inside", "flip", "emit"}) keys.push_back(key);
  return {node, what, keys};
}

// What every surface says of itself; `material` is left to the caller.
SurfaceDescription read_common(ReadContext& context, const JsonObject& o, const Affine& parent) {
  SurfaceDescription s;
  s.pointer = o.node().pointer();
  s.name = o.string("name", "");
  const auto transform = o.find("transform");
  s.transform = transform ? parent * read_transform(*transform) : parent;
  if (const auto outside = o.find("outside")) s.outside = read_medium(context, *outside);
  if (const auto inside = o.find("inside")) s.inside = read_medium(context, *inside);
  if (const auto emit = o.find("emit")) s.emit = read_spectrum(context, *emit, SpectrumRole::Emission, kNotNegative);
  s.flip = o.boolean("flip", false);
  return s;
}

void read_quad(ReadContext& context, const JsonNode& node, const Affine& parent) {
  const JsonObject o = surface_object(node, "a quad", {"size"});
  SurfaceDescription s = read_common(context, o, parent);
  s.kind = SurfaceKind::Quad;
  s.material = read_material(context, o.require("material"));
  if (const auto size = o.find("size")) {
    if (size->is_number()) {
      s.width = s.height = size->number(kPositive);
    } else {
      size->numbers(2);
      s.width = (*size)[0].number(kPositive);
      s.height = (*size)[1].number(kPositive);
    }
  }
  context.scene.surfaces.push_back(s);
}

void read_sphere(ReadContext& context, const JsonNode& node, const Affine& parent) {
  const JsonObject o = surface_object(node, "a sphere", {"radius"});
  SurfaceDescription s = read_common(context, o, parent);
  s.kind = SurfaceKind::Sphere;
  s.material = read_material(context, o.require("material"));
  s.radius = o.number("radius", 1, kPositive);
  context.scene.surfaces.push_back(s);
}

// Three corners as v0, v1, v2, or as darts' `positions` with optional `normals` and `uvs`.
void read_triangle(ReadContext& context, const JsonNode& node, const Affine& parent) {
  const JsonObject o = surface_object(node, "a triangle", {"v0", "v1", "v2", "positions", "normals", "uvs"});
  SurfaceDescription s = read_common(context, o, parent);
  s.kind = SurfaceKind::Triangle;
  s.material = read_material(context, o.require("material"));
  auto mesh = std::make_shared<MeshData>();
  const auto three = [&](const JsonNode& list) {
    if (!list.is_array() || list.size() != 3) list.fail("expected an array of three");
    return list;
  };
  if (const auto positions = o.find("positions")) {
    for (const char* key : {"v0", "v1", "v2"})
      if (const auto v = o.find(key)) v->fail_at_key("the triangle already has \"positions\"");
    for (std::size_t i = 0; i < 3; i++) mesh->positions.push_back(three(*positions)[i].vector());
  } else {
    for (const char* key : {"v0", "v1", "v2"}) mesh->positions.push_back(o.require(key).vector());
  }
  if (const auto normals = o.find("normals"))
    for (std::size_t i = 0; i < 3; i++) {
      const JsonNode normal = three(*normals)[i];
      if (!(length(normal.vector()) > 0)) normal.fail("the normal is zero");
      mesh->normals.push_back(normalize(normal.vector()));
    }
  if (const auto uvs = o.find("uvs"))
    for (std::size_t i = 0; i < 3; i++) {
      const auto uv = three(*uvs)[i].numbers(2);
      mesh->uvs.push_back({uv[0], uv[1]});
    }
  mesh->triangles.push_back({0, 1, 2});
  RawMesh raw = raw_mesh_of(*mesh);
  if (drop_degenerate_faces(raw) > 0) node.fail("the triangle has no area");
  s.mesh = mesh;
  context.scene.surfaces.push_back(s);
}

RawMesh generate(const ReadContext& context, const JsonObject& o) {
  const JsonNode name = o.require("generator");
  const std::string text = name.string();
  if (text != "head" && text != "hand")
    name.fail("no generator is called \"" + text + "\" (there are head and hand)" + did_you_mean(text, {"head", "hand"}));
  GeneratorOptions options;
  options.resolution = o.number("resolution", options.resolution, {0.3, 10});
  options.pose = o.string("pose", "");
  if (const auto parameters = o.find("parameters")) {
    if (!parameters->is_object()) parameters->fail_type("an object of numbers");
    for (const auto& item : parameters->json().items()) options.parameters.emplace_back(item.key(), parameters->child(item.key()).number());
  }
  try {
    MeshData mesh = generate_mesh(text, options);
    for (Vec3d& p : mesh.positions) p = p * context.units_per_millimetre();
    return raw_mesh_of(mesh);
  } catch (const std::invalid_argument& error) {
    o.node().fail(error.what());
  }
}

RawMesh offset_mesh(ReadContext& context, const JsonObject& o, RawMesh& mesh, double offset, bool by_distance_field,
                    const Affine& to_world) {
  const JsonNode node = o.require("offset");
  if (by_distance_field) {
    if (mesh.materials.size() > 1) node.fail("a mesh of several materials has no offset by distance field");
    try {
      std::size_t faulty = 0;
      RawMesh shell = offset_surface(mesh, offset, to_world, &faulty);
      if (faulty > 0)
        context.warn(node, std::to_string(faulty) + " places of the offset surface's " + std::to_string(shell.faces.size()) +
                               " triangles are over 5 % off the distance, turned over or crossing");
      return shell;
    } catch (const std::runtime_error& error) {
      node.fail(error.what());
    }
  }
  const std::size_t total = mesh.faces.size();
  if (const std::size_t flipped = offset_positions(mesh, offset, to_world))
    context.warn(node, "the offset turned " + std::to_string(flipped) + " of " + std::to_string(total) + " triangles over");
  if (const std::size_t collapsed = drop_degenerate_faces(mesh))
    context.warn(node, "the offset left " + std::to_string(collapsed) + " triangles without area");
  if (mesh.faces.empty()) node.fail("the offset leaves nothing of the mesh");
  return mesh;
}

RawMesh load_mesh(ReadContext& context, const JsonObject& o, const Affine& to_world) {
  const auto filename = o.find("filename");
  if (filename.has_value() == o.has("generator")) o.node().fail("a mesh needs \"filename\" or \"generator\", one of them");
  const double offset = o.number("offset", 0);
  const std::string method = canonical_type(o.string("offset method", "normals"));
  if (method != "normals" && method != "distance field")
    o.require("offset method").fail("expected \"normals\" or \"distance field\"" + did_you_mean(method, {"normals", "distance field"}));
  const bool by_distance_field = method == "distance field";
  if (filename)
    for (const char* key : {"resolution", "pose", "parameters"})
      if (const auto value = o.find(key)) value->fail_at_key("this key is for generated meshes");

  RawMesh mesh = filename ? read_obj(*filename, context.file_path(*filename)) : generate(context, o);
  const std::size_t total = mesh.faces.size();
  if (const std::size_t dropped = drop_degenerate_faces(mesh))
    context.warn(o.node(), std::to_string(dropped) + " of " + std::to_string(total) + " triangles have no area and were dropped");
  if (mesh.faces.empty()) o.node().fail("no triangle of the mesh has an area");
  if (offset != 0) return offset_mesh(context, o, mesh, offset, by_distance_field, to_world);
  return mesh;
}

// The material of faces after `usemtl name`: the prefixed name, or with a warning the surface's own.
MaterialPtr material_for(ReadContext& context, const JsonObject& o, const std::string& name, const MaterialPtr& own) {
  if (name.empty()) {
    if (!own) o.node().fail("a mesh needs \"material\" for its faces without usemtl");
    return own;
  }
  const std::string full = o.string("material prefix", "") + name;
  if (const MaterialPtr* found = context.materials.find(full)) return *found;
  const std::string message = "the mesh uses a material \"" + full + "\" that the scene does not define";
  if (!own) o.node().fail(message);
  // Files that name materials out of habit are common; only who asks for a prefix means it.
  if (o.has("material prefix")) context.warn(o.node(), message + "; its own is used");
  return own;
}

void read_mesh(ReadContext& context, const JsonNode& node, const Affine& parent) {
  const JsonObject o = surface_object(
      node, "a mesh", {"filename", "generator", "resolution", "pose", "parameters", "offset", "offset method", "material prefix"});
  SurfaceDescription s = read_common(context, o, parent);
  s.kind = SurfaceKind::Mesh;
  const auto material = o.find("material");
  const MaterialPtr own = material ? read_material(context, *material) : nullptr;
  if (!own && o.has("generator")) o.require("material");
  const RawMesh raw = load_mesh(context, o, s.transform);
  for (int i = 0; i < static_cast<int>(raw.materials.size()); i++) {
    MeshData part = extract_material(raw, i);
    if (part.triangles.empty()) continue;
    s.material = material_for(context, o, raw.materials[i], own);
    s.mesh = std::make_shared<MeshData>(std::move(part));
    context.scene.surfaces.push_back(s);
  }
}

void read_surface(ReadContext& context, const JsonNode& node, const Affine& parent);

void read_children(ReadContext& context, const JsonNode& list, const Affine& parent) {
  if (!list.is_array()) list.fail_type("an array of surfaces");
  for (std::size_t i = 0; i < list.size(); i++) read_surface(context, list[i], parent);
}

void read_group(ReadContext& context, const JsonNode& node, const Affine& parent) {
  // The last two steer how darts divides space.
  const JsonObject o(node, "a group", {"type", "name", "transform", "children", "surfaces", "split method", "max leaf size"});
  if (o.has("children") && o.has("surfaces")) o.require("surfaces").fail_at_key("the group already has \"children\"");
  const auto transform = o.find("transform");
  const JsonNode children = o.has("surfaces") ? o.require("surfaces") : o.require("children");
  read_children(context, children, transform ? parent * read_transform(*transform) : parent);
}

void read_surface(ReadContext& context, const JsonNode& node, const Affine& parent) {
  const std::string type = type_of(node, "a surface");
  if (type == "quad") return read_quad(context, node, parent);
  if (type == "sphere") return read_sphere(context, node, parent);
  if (type == "triangle") return read_triangle(context, node, parent);
  if (type == "mesh") return read_mesh(context, node, parent);
  // darts' acceleration structures are groups too.
  if (type == "group" || type == "bbh" || type == "linear") return read_group(context, node, parent);
  const JsonNode name = node.child("type");
  name.fail("no surface has the type \"" + name.string() + "\"" + did_you_mean(type, kTypes));
}

}  // namespace

void read_surfaces(ReadContext& context, const JsonNode& list) {
  read_children(context, list, Affine{});
  expand_skin(context);
}

}  // namespace stokes
