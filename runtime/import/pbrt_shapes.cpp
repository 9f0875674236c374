// pbrt's shapes and object instances. Knows the graphics state, not how it came about.
#include <cmath>
#include <filesystem>

#include "import/media_around.h"
#include "import/pbrt_import.h"
#include "input/limits.h"

namespace stokes {
namespace {

std::vector<std::array<double, 3>> triples(const std::vector<double>& v) {
  std::vector<std::array<double, 3>> all;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) all.push_back({v[i], v[i + 1], v[i + 2]});
  return all;
}

std::vector<std::array<double, 2>> pairs(const std::vector<double>& v) {
  std::vector<std::array<double, 2>> all;
  for (std::size_t i = 0; i + 1 < v.size(); i += 2) all.push_back({v[i], v[i + 1]});
  return all;
}

Vec3d vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// A triangle's front is where its normals point, whatever its winding.
void turn_to_normals(ImportedMesh& mesh) {
  if (mesh.normals.empty()) return;
  for (auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return vector_of(mesh.positions[static_cast<std::size_t>(t[k])]); };
    const auto normal = [&](std::size_t k) { return vector_of(mesh.normals[static_cast<std::size_t>(t[k])]); };
    if (dot(cross(at(1) - at(0), at(2) - at(0)), normal(0) + normal(1) + normal(2)) < 0) std::swap(t[1], t[2]);
  }
}

// pbrt's texture coordinates of triangles that bring none: the same for each triangle, so vertices are no longer shared.
void give_default_uvs(ImportedMesh& mesh) {
  ImportedMesh apart;
  for (const auto& t : mesh.triangles) {
    const int first = static_cast<int>(apart.positions.size());
    for (const int corner : t) {
      apart.positions.push_back(mesh.positions[static_cast<std::size_t>(corner)]);
      if (!mesh.normals.empty()) apart.normals.push_back(mesh.normals[static_cast<std::size_t>(corner)]);
    }
    for (const auto& uv : {std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{1.0, 1.0}}) apart.uvs.push_back(uv);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  mesh = std::move(apart);
}

}  // namespace

ImportJson PbrtImport::mesh_of(const std::string& name, ImportedMesh mesh) {
  turn_to_normals(mesh);
  bool textured = has_image(state_.material);
  for (const ImportJson& m : out_.json["materials"])
    if (state_.material == m["name"]) textured = has_image(m);
  if (mesh.uvs.empty() && textured) give_default_uvs(mesh);
  const std::string file = target_.stem + "_meshes/" + name + "_" + std::to_string(out_.meshes.size()) + ".obj";
  out_.meshes.emplace_back(file, std::move(mesh));
  return {{"type", "mesh"}, {"filename", file}};
}

ImportedMesh PbrtImport::triangles_of(const PbrtDirective& d) {
  ImportedMesh mesh;
  const PbrtParameter *p = d.find("P"), *n = d.find("N"), *uv = d.find("uv"), *indices = d.find("indices");
  if (!p || p->numbers.size() % 3 != 0) throw ImportError(d.file, d.line, "the mesh has no \"point3 P\"");
  mesh.positions = triples(p->numbers);
  if (n && n->numbers.size() == p->numbers.size()) mesh.normals = triples(n->numbers);
  if (uv && uv->numbers.size() == 2 * mesh.positions.size()) mesh.uvs = pairs(uv->numbers);
  if ((n && mesh.normals.empty()) || (uv && mesh.uvs.empty())) throw ImportError(d.file, d.line, "N and uv need one entry for each of P");
  const bool patches = d.words.at(0) == "bilinearmesh";
  const std::size_t corners = patches ? 4 : 3;
  std::vector<double> list = indices ? indices->numbers : std::vector<double>();
  if (!indices && mesh.positions.size() != corners) throw ImportError(d.file, d.line, "the mesh has no \"integer indices\"");
  for (std::size_t k = 0; !indices && k < corners; k++) list.push_back(static_cast<double>(k));
  if (list.size() % corners != 0) throw ImportError(d.file, indices->line, "the number of indices is no multiple of " + std::to_string(corners));
  for (const double index : list)
    if (index < 0 || index >= static_cast<double>(mesh.positions.size()) || index != std::floor(index)) throw ImportError(d.file, d.line, "an index is out of range");
  const auto corner = [&](std::size_t i) { return static_cast<int>(list[i]); };
  if (!patches)
    for (std::size_t i = 0; i < list.size(); i += 3) mesh.triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
  // A patch's corners stand row by row; flat ones are two triangles.
  for (std::size_t i = 0; patches && i < list.size(); i += 4) {
    mesh.triangles.push_back({corner(i), corner(i + 1), corner(i + 3)});
    mesh.triangles.push_back({corner(i), corner(i + 3), corner(i + 2)});
  }
  if (patches) note(d, "bilinear patches become two triangles each");
  // A patch without coordinates of its own has the unit square's.
  if (patches && mesh.uvs.empty() && mesh.positions.size() == 4) mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  if (mesh.triangles.empty()) throw ImportError(d.file, d.line, "the mesh has no triangles");
  return mesh;
}

ImportJson PbrtImport::shape_of(const PbrtDirective& d, const std::string& type) {
  if (type == "sphere") return {{"type", "sphere"}, {"radius", d.number("radius", 1)}};
  if (type == "trianglemesh" || type == "bilinearmesh") return mesh_of("mesh", triangles_of(d));
  if (type != "plymesh") return nullptr;
  const std::string file = d.text("filename", "");
  if (file.empty()) throw ImportError(d.file, d.line, "the plymesh names no file");
  try {
    return mesh_of(std::filesystem::path(file).stem().string(), read_ply(path_beside(target_, folder_, file)));
  } catch (const ImportError&) {
    throw;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw ImportError(d.file, d.line, file + " cannot be read as PLY: " + error.what());
  }
}

// A shape between two media sets them. One that has the same on both sides leaves the ray's medium as it is: it is named at the end.
void PbrtImport::set_media(const PbrtDirective& d, ImportJson& surface) {
  const std::string inside = medium_named(d, state_.inside), outside = medium_named(d, state_.outside);
  if (inside == outside) return;
  if (!inside.empty()) surface["inside"] = inside;
  if (!outside.empty()) surface["outside"] = outside;
}

void PbrtImport::apply_shape(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  ImportJson surface = shape_of(d, type);
  if (surface.is_null()) {
    note(d, "a shape of type \"" + type + "\" has no counterpart here and was left out");
    for (const PbrtParameter& p : d.parameters) p.used = true;
    return;
  }
  if (const ImportJson t = transform_json(state_.transform); !t.is_null()) surface["transform"] = t;
  surface["material"] = state_.material;
  if (!state_.emit.is_null() && object_.empty()) surface["emit"] = state_.emit;
  if (!state_.emit.is_null() && !object_.empty()) note(d, "lamps in objects do not shine, as in pbrt");
  surface[kPlaceKey] = place_of(d.file, d.line);
  set_media(d, surface);
  if (state_.reverse) surface["flip"] = true;
  count_surfaces(d, 1);
  (object_.empty() ? out_.json["surfaces"] : objects_[object_]).push_back(surface);
}

void PbrtImport::count_surfaces(const PbrtDirective& d, std::size_t more) {
  surface_count_ += more;
  if (surface_count_ > kMostSurfaces) throw ImportError(d.file, d.line, "more than " + std::to_string(kMostSurfaces) + " surfaces, those of instances included");
}

bool PbrtImport::apply_object(const PbrtDirective& d) {
  const std::string name = d.words.empty() ? "" : d.words[0];
  if (d.name == "ObjectBegin") {
    if (!object_.empty() || name.empty() || objects_.count(name)) throw ImportError(d.file, d.line, "ObjectBegin needs a new name, and objects do not nest");
    stack_.emplace_back(state_, true);
    object_ = name;
    objects_[name] = ImportJson::array();
  } else if (d.name == "ObjectEnd") {
    if (object_.empty() || stack_.empty()) throw ImportError(d.file, d.line, "ObjectEnd without its beginning");
    state_ = stack_.back().first;
    stack_.pop_back();
    object_.clear();
  } else if (d.name == "ObjectInstance") {
    if (!object_.empty()) throw ImportError(d.file, d.line, "an instance stands inside of an object");
    const auto it = objects_.find(name);
    if (it == objects_.end()) throw ImportError(d.file, d.line, "no object is called \"" + name + "\"");
    if (it->second.empty()) return true;
    count_surfaces(d, it->second.size());
    ImportJson group = {{"type", "group"}, {"children", it->second}};
    if (const ImportJson t = transform_json(state_.transform); !t.is_null()) group["transform"] = t;
    out_.json["surfaces"].push_back(group);
  } else {
    return false;
  }
  return true;
}

}  // namespace stokes
