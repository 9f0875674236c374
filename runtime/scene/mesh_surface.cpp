// Meshes from files and generators: their keys first, their triangles later.
#include "scene/mesh_surface.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "mesh/generate.h"
#include "scene/material_reader.h"
#include "scene/mesh_reader.h"
#include "scene/recent_meshes.h"

namespace stokes {
namespace {

constexpr std::uintmax_t kQuickBytes = 1 << 20;  // an OBJ file of this size is read in some milliseconds

// What a mesh's JSON says, checked.
struct MeshRequest {
  JsonObject o;
  MaterialPtr own;           // null: only materials by usemtl
  std::string path;          // of the file; empty: generated
  std::string generator;
  GeneratorOptions options;
  double offset = 0;
  bool by_distance_field = false;
};

struct Box {
  Vec3d lo, hi;
};

void read_generator(const ReadContext& context, const JsonObject& o, MeshRequest& request, SurfaceDescription& stand_in, Box& box) {
  const JsonNode name = o.require("generator");
  request.generator = name.string();
  if (request.generator != "head" && request.generator != "hand")
    name.fail("no generator is called \"" + request.generator + "\" (there are head and hand)" + did_you_mean(request.generator, {"head", "hand"}));
  GeneratorOptions& options = request.options;
  options.resolution = o.number("resolution", options.resolution, {0.3, 10});
  options.pose = o.string("pose", "");
  if (const auto parameters = o.find("parameters")) {
    if (!parameters->is_object()) parameters->fail_type("an object of numbers");
    for (const auto& item : parameters->json().items()) options.parameters.emplace_back(item.key(), parameters->child(item.key()).number());
  }
  try {
    const GeneratorPlan plan = plan_mesh(request.generator, options);
    context.require_memory(o.node(), plan.bytes, "the " + request.generator);
    box = {plan.lo * context.units_per_millimetre(), plan.hi * context.units_per_millimetre()};
    auto mesh = std::make_shared<MeshData>(*stand_in.mesh);
    for (const std::string& mask : plan.masks) mesh->masks.emplace_back(mask, std::vector<float>(3, 0.0f));
    stand_in.mesh = mesh;
  } catch (const std::invalid_argument& error) {
    o.node().fail(error.what());
  }
}

// An offset that leaves nothing, or the mesh a speck within it, is a mistake in its unit.
void check_offset(const JsonNode& node, const MeshRequest& request, const Affine& to_world, const Box& box) {
  Vec3d lo = to_world.point(box.lo), hi = lo;
  for (int corner = 1; corner < 8; corner++) {
    const Vec3d p = to_world.point({corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z});
    lo = min(lo, p), hi = max(hi, p);
  }
  constexpr double kTimesTheSize = 100;
  const Vec3d size = hi - lo;
  if (!(std::abs(request.offset) <= kTimesTheSize * length(size)))
    node.fail("the offset is more than " + show(kTimesTheSize) + " times the mesh's size, " + show(length(size), 6));
  if (request.by_distance_field && -request.offset >= std::min({size.x, size.y, size.z}) / 2) node.fail("the offset leaves nothing of the mesh");
}

Box bounds(const RawMesh& mesh) {
  Box box{mesh.positions[0], mesh.positions[0]};
  for (const Vec3d& p : mesh.positions) box = {min(box.lo, p), max(box.hi, p)};
  return box;
}

// One triangle that reaches through the box, with all that a mesh may bring along.
std::shared_ptr<MeshData> triangle_within(const Box& box, const MeshData* model) {
  auto mesh = model ? std::make_shared<MeshData>(*model) : std::make_shared<MeshData>();
  mesh->positions = {box.lo, {box.hi.x, box.hi.y, box.lo.z}, box.hi};
  mesh->normals.assign(3, Vec3d{0, 0, 1});
  mesh->uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh->triangles = {{0, 1, 2}};
  return mesh;
}

RawMesh offset_mesh(const MeshRequest& request, RawMesh& mesh, const Affine& to_world, MadeMesh& made) {
  const JsonNode node = request.o.require("offset");
  check_offset(node, request, to_world, bounds(mesh));
  if (request.by_distance_field) {
    if (mesh.materials.size() > 1) node.fail("a mesh of several materials has no offset by distance field");
    try {
      std::size_t faulty = 0;
      RawMesh shell = offset_surface(mesh, request.offset, to_world, &faulty);
      if (faulty > 0)
        made.warnings.emplace_back("offset", std::to_string(faulty) + " places of the offset surface's " + std::to_string(shell.faces.size()) +
                                                 " triangles are over 5 % off the distance, turned over or crossing");
      return shell;
    } catch (const std::runtime_error& error) {
      node.fail(error.what());
    }
  }
  const std::size_t total = mesh.faces.size();
  if (const std::size_t flipped = offset_positions(mesh, request.offset, to_world))
    made.warnings.emplace_back("offset", "the offset turned " + std::to_string(flipped) + " of " + std::to_string(total) + " triangles over");
  if (const std::size_t collapsed = drop_degenerate_faces(mesh))
    made.warnings.emplace_back("offset", "the offset left " + std::to_string(collapsed) + " triangles without area");
  if (mesh.faces.empty()) node.fail("the offset leaves nothing of the mesh");
  return std::move(mesh);
}

/// All that a generated mesh depends on but its offset.
std::string generator_key(const ReadContext& context, const MeshRequest& request) {
  std::string key = request.generator + " " + request.options.pose + " " + show(request.options.resolution) + " " + show(context.units_per_millimetre());
  for (const auto& [name, value] : request.options.parameters) key += " " + name + "=" + show(value);
  return key;
}

/// Likewise for a mesh from a file: which one it is, when it was last changed, and how much of it is allowed.
std::string file_key(const ReadContext& context, const std::string& path) {
  struct stat file = {};
  stat(path.c_str(), &file);
  const auto words = [](auto... numbers) { return ((" " + std::to_string(numbers)) + ...); };
  return path + words(file.st_dev, file.st_ino, file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec, file.st_ctim.tv_sec, file.st_ctim.tv_nsec) +
         words(context.limits.vertices, context.limits.faces, context.limits.materials);
}

std::string mesh_key(const ReadContext& context, const MeshRequest& request, const Affine& to_world) {
  const std::string key = request.path.empty() ? generator_key(context, request) : file_key(context, request.path);
  if (request.offset == 0) return key;
  return key + (request.by_distance_field ? " distance field" : " normals") + offset_key(request.offset, to_world);
}

/// Skin is several surfaces about one head, which is generated once.
RawMesh generate(ReadContext& context, const MeshRequest& request) {
  std::shared_ptr<const MeshData>& known = context.generated[generator_key(context, request)];
  if (!known) {
    auto mesh = std::make_shared<MeshData>(generate_mesh(request.generator, request.options));
    for (Vec3d& p : mesh->positions) p = p * context.units_per_millimetre();
    known = mesh;
  }
  return raw_mesh_of(*known);
}

RawMesh load_mesh(ReadContext& context, const MeshRequest& request, const Affine& to_world, MadeMesh& made) {
  const JsonObject& o = request.o;
  RawMesh mesh = request.path.empty() ? generate(context, request) : read_obj(context, o.require("filename"), request.path);
  const std::size_t total = mesh.faces.size();
  if (const std::size_t dropped = drop_degenerate_faces(mesh))
    made.warnings.emplace_back("", std::to_string(dropped) + " of " + std::to_string(total) + " triangles have no area and were dropped");
  if (mesh.faces.empty()) o.node().fail("no triangle of the mesh has an area");
  if (request.offset != 0) return offset_mesh(request, mesh, to_world, made);
  return mesh;
}

// The material of faces after `usemtl name`: the prefixed name, or with a warning the surface's own.
MaterialPtr material_for(ReadContext& context, const MeshRequest& request, const std::string& name) {
  const JsonObject& o = request.o;
  if (name.empty()) {
    if (!request.own) o.node().fail("a mesh needs \"material\" for its faces without usemtl");
    return request.own;
  }
  const std::string full = o.string("material prefix", "") + name;
  if (const MaterialPtr* found = context.materials.find(full)) return *found;
  const std::string message = "the mesh uses a material \"" + full + "\" that the scene does not define";
  if (!request.own) o.node().fail(message);
  // Files that name materials out of habit are common; only who asks for a prefix means it.
  if (o.has("material prefix")) context.warn(o.node(), message + "; its own is used");
  return request.own;
}

MadeMesh make_mesh(ReadContext& context, const MeshRequest& request, const Affine& to_world) {
  MadeMesh made;
  const RawMesh raw = load_mesh(context, request, to_world, made);
  std::vector<MeshData> parts = extract_materials(raw);
  for (std::size_t i = 0; i < parts.size(); i++) {
    if (parts[i].triangles.empty()) continue;
    made.parts.push_back(std::make_shared<MeshData>(std::move(parts[i])));
    made.materials.push_back(raw.materials[i]);
  }
  return made;
}

std::vector<SurfaceDescription> make_surfaces(ReadContext& context, const MeshRequest& request, SurfaceDescription s) {
  const MadeMesh made = recent_mesh(mesh_key(context, request, s.transform), nullptr, [&] { return make_mesh(context, request, s.transform); });
  for (const auto& [key, text] : made.warnings) context.warn(key.empty() ? request.o.node() : request.o.require(key.c_str()), text);
  std::vector<SurfaceDescription> surfaces;
  for (std::size_t i = 0; i < made.parts.size(); i++) {
    s.material = material_for(context, request, made.materials[i]);
    s.mesh = made.parts[i];
    surfaces.push_back(s);
  }
  return surfaces;
}

MeshRequest read_request(ReadContext& context, const JsonObject& o) {
  MeshRequest request{o, nullptr, "", "", {}, 0, false};
  const auto material = o.find("material"), filename = o.find("filename");
  if (material) request.own = read_material(context, *material);
  if (!request.own && o.has("generator")) o.require("material");
  o.string("material prefix", "");
  if (filename.has_value() == o.has("generator")) o.node().fail("a mesh needs \"filename\" or \"generator\", one of them");
  request.offset = o.number("offset", 0);
  const std::string method = canonical_type(o.string("offset method", "normals"));
  if (method != "normals" && method != "distance field")
    o.require("offset method").fail("expected \"normals\" or \"distance field\"" + did_you_mean(method, {"normals", "distance field"}));
  request.by_distance_field = method == "distance field";
  if (filename)
    for (const char* key : {"resolution", "pose", "parameters"})
      if (const auto value = o.find(key)) value->fail_at_key("this key is for generated meshes");
  return request;
}

}  // namespace

std::vector<std::string> mesh_keys() {
  return {"filename", "generator", "resolution", "pose", "parameters", "offset", "offset method", "material prefix"};
}

SurfaceDraft draft_mesh(ReadContext& context, const JsonObject& o, SurfaceDescription surface) {
  MeshRequest request = read_request(context, o);
  surface.kind = SurfaceKind::Mesh;
  // Without a material of its own the file's names decide; until they are known anything serves.
  surface.material = request.own ? request.own : std::make_shared<MaterialDescription>();
  SurfaceDraft draft{surface, nullptr, request.offset != 0 && request.by_distance_field ? LoadingTime::Long : LoadingTime::Short};
  Box box{{-1, -1, -1}, {1, 1, 1}};
  draft.surface.mesh = triangle_within(box, nullptr);
  if (const auto filename = o.find("filename")) {
    request.path = context.file_path(*filename, FileSort::Mesh);
    std::error_code error;
    const auto bytes = std::filesystem::file_size(request.path, error);
    if (error || bytes > kQuickBytes) draft.time = std::max(draft.time, LoadingTime::Reading);
  } else {
    read_generator(context, o, request, draft.surface, box);
    if (request.offset != 0) check_offset(o.require("offset"), request, surface.transform, box);
    draft.surface.mesh = triangle_within(box, draft.surface.mesh.get());
    draft.time = LoadingTime::Long;
  }
  draft.load = [request, surface](ReadContext& c) { return make_surfaces(c, request, surface); };
  return draft;
}

}  // namespace stokes
