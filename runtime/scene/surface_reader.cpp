// The types of surfaces, one function each.
#include "scene/surface_reader.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "scene/material_reader.h"
#include "scene/medium_reader.h"
#include "scene/mesh_reader.h"
#include "scene/mesh_surface.h"
#include "scene/skin_reader.h"
#include "scene/spectrum_reader.h"
#include "scene/transform_reader.h"

namespace stokes {
namespace {

const std::vector<std::string> kTypes = {"quad", "sphere", "triangle", "mesh", "group"};

// A surface and its place in the tree above it.
struct Place {
  ReadContext& context;
  std::vector<SurfaceDraft>& drafts;
  Affine parent;
};

void add(const Place& place, const SurfaceDescription& s) { place.drafts.push_back({s, nullptr, LoadingTime::Short}); }

JsonObject surface_object(const JsonNode& node, const std::string& what, std::vector<std::string> keys) {
  for (const char* key : {"type", "name", "transform", "material", "outside", "inside", "flip", "emit"}) keys.push_back(key);
  return {node, what, keys};
}

// What every surface says of itself; `material` is left to the caller.
SurfaceDescription read_common(const Place& place, const JsonObject& o) {
  SurfaceDescription s;
  s.pointer = o.node().pointer();
  s.name = o.string("name", "");
  const auto transform = o.find("transform");
  s.transform = transform ? place.parent * read_transform(*transform) : place.parent;
  // The product of the groups' transforms may overflow.
  if (!std::all_of(s.transform.m.begin(), s.transform.m.end(), [](double v) { return std::isfinite(v); })) o.node().fail("the transform is not finite");
  if (const auto outside = o.find("outside")) s.outside = read_medium(place.context, *outside);
  if (const auto inside = o.find("inside")) s.inside = read_medium(place.context, *inside);
  if (const auto emit = o.find("emit")) s.emit = read_spectrum(place.context, *emit, SpectrumRole::Emission, kNotNegative);
  s.flip = o.boolean("flip", false);
  return s;
}

void read_quad(const Place& place, const JsonNode& node) {
  const JsonObject o = surface_object(node, "a quad", {"size"});
  SurfaceDescription s = read_common(place, o);
  s.kind = SurfaceKind::Quad;
  s.material = read_material(place.context, o.require("material"));
  if (const auto size = o.find("size")) {
    if (size->is_number()) {
      s.width = s.height = size->number(kPositive);
    } else {
      size->numbers(2);
      s.width = (*size)[0].number(kPositive);
      s.height = (*size)[1].number(kPositive);
    }
  }
  add(place, s);
}

void read_sphere(const Place& place, const JsonNode& node) {
  const JsonObject o = surface_object(node, "a sphere", {"radius"});
  SurfaceDescription s = read_common(place, o);
  s.kind = SurfaceKind::Sphere;
  s.material = read_material(place.context, o.require("material"));
  s.radius = o.number("radius", 1, kPositive);
  add(place, s);
}

// Three corners as v0, v1, v2, or as darts' `positions` with optional `normals` and `uvs`.
void read_triangle(const Place& place, const JsonNode& node) {
  const JsonObject o = surface_object(node, "a triangle", {"v0", "v1", "v2", "positions", "normals", "uvs"});
  SurfaceDescription s = read_common(place, o);
  s.kind = SurfaceKind::Triangle;
  s.material = read_material(place.context, o.require("material"));
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
  add(place, s);
}

void read_mesh(const Place& place, const JsonNode& node) {
  const JsonObject o = surface_object(node, "a mesh", mesh_keys());
  place.drafts.push_back(draft_mesh(place.context, o, read_common(place, o)));
}

void read_surface(const Place& place, const JsonNode& node);

void read_children(const Place& place, const JsonNode& list) {
  if (!list.is_array()) list.fail_type("an array of surfaces");
  for (std::size_t i = 0; i < list.size(); i++) read_surface(place, list[i]);
  place.context.require_within(list, place.drafts.size(), &InputLimits::surfaces);
}

void read_group(const Place& place, const JsonNode& node) {
  // The last two steer how darts divides space.
  const JsonObject o(node, "a group", {"type", "name", "transform", "children", "surfaces", "split method", "max leaf size"});
  if (o.has("children") && o.has("surfaces")) o.require("surfaces").fail_at_key("the group already has \"children\"");
  const auto transform = o.find("transform");
  const JsonNode children = o.has("surfaces") ? o.require("surfaces") : o.require("children");
  read_children({place.context, place.drafts, transform ? place.parent * read_transform(*transform) : place.parent}, children);
}

void read_surface(const Place& place, const JsonNode& node) {
  const std::string type = type_of(node, "a surface");
  if (type == "quad") return read_quad(place, node);
  if (type == "sphere") return read_sphere(place, node);
  if (type == "triangle") return read_triangle(place, node);
  if (type == "mesh") return read_mesh(place, node);
  // darts' acceleration structures are groups too.
  if (type == "group" || type == "bbh" || type == "linear") return read_group(place, node);
  const JsonNode name = node.child("type");
  name.fail("no surface has the type \"" + name.string() + "\"" + did_you_mean(type, kTypes));
}

}  // namespace

void read_surfaces(ReadContext& context, const JsonNode& list, const std::function<void(const SceneDescription&)>& before_meshes) {
  std::vector<SurfaceDraft> drafts;
  read_children({context, drafts, Affine{}}, list);
  // Faults that need no mesh are found before meshes take their time.
  LoadingTime longest = LoadingTime::Short;
  for (const SurfaceDraft& draft : drafts) {
    check_skin(context, draft.surface);
    context.scene.surfaces.push_back(draft.surface);
    longest = std::max(longest, draft.time);
  }
  if (longest > LoadingTime::Short && before_meshes) before_meshes(context.scene);
  // Likewise a broken file before a head is made.
  std::vector<std::vector<SurfaceDescription>> made(drafts.size());
  std::size_t count = 0;
  for (const LoadingTime time : {LoadingTime::Short, LoadingTime::Reading, LoadingTime::Long})
    for (std::size_t i = 0; i < drafts.size(); i++) {
      if (drafts[i].time != time) continue;
      if (drafts[i].load)
        made[i] = drafts[i].load(context);
      else
        made[i] = {drafts[i].surface};
      count += made[i].size();
      context.require_within(list, count, &InputLimits::surfaces);
    }
  context.scene.surfaces.clear();
  for (std::vector<SurfaceDescription>& surfaces : made) std::move(surfaces.begin(), surfaces.end(), std::back_inserter(context.scene.surfaces));
  expand_skin(context);
}

}  // namespace stokes
