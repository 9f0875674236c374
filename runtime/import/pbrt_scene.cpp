// A pbrt scene's frame: the graphics state, camera, film, lights and shapes.
#include <cmath>
#include <filesystem>
#include <numbers>

#include "import/pbrt_import.h"

namespace stokes {
namespace {

std::string folder_of(const PbrtDirective& d) { return std::filesystem::path(d.file).parent_path().string(); }

// pbrt's matrices stand column by column.
bool transposed_matrix_of(const std::vector<double>& m, Affine& out) {
  if (m.size() != 16) return false;
  std::vector<double> rows(16);
  for (std::size_t i = 0; i < 16; i++) rows[i % 4 * 4 + i / 4] = m[i];
  return matrix_of(rows, out);
}

}  // namespace

PbrtImport::PbrtImport(const std::string& path, ImportTarget target) : target_(std::move(target)), path_(path) {}

void PbrtImport::note_unused(const PbrtDirective& d) {
  for (const PbrtParameter& p : d.parameters)
    if (!p.used) out_.note(d.file, p.line, "\"" + p.type + " " + p.name + "\" of " + d.name + " has no counterpart here and was left out");
}

bool PbrtImport::apply_transform(const PbrtDirective& d) {
  const std::vector<double>& n = d.numbers;
  const auto need = [&](std::size_t count) {
    if (n.size() != count) throw ImportError(d.file, d.line, d.name + " needs " + std::to_string(count) + " numbers");
  };
  Affine step;
  if (d.name == "Identity") {
    state_.transform = Affine{};
  } else if (d.name == "Translate") {
    need(3);
    state_.transform = state_.transform * translation_of({n[0], n[1], n[2]});
  } else if (d.name == "Scale") {
    need(3);
    state_.transform = state_.transform * scaling_of({n[0], n[1], n[2]});
  } else if (d.name == "Rotate") {
    need(4);
    state_.transform = state_.transform * rotation_of(n[0], normalize(Vec3d{n[1], n[2], n[3]}));
  } else if (d.name == "LookAt") {
    need(9);
    state_.transform = state_.transform * look_at_of({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}).inverse();
  } else if (d.name == "Transform" || d.name == "ConcatTransform") {
    if (!transposed_matrix_of(n, step)) throw ImportError(d.file, d.line, d.name + " needs 16 numbers of an affine map");
    state_.transform = d.name == "Transform" ? step : state_.transform * step;
  } else {
    return false;
  }
  return true;
}

bool PbrtImport::apply_setting(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  if (d.name == "Camera") {
    if (type != "perspective") note(d, "a camera of type \"" + type + "\" has no counterpart here: a perspective one is taken");
    world_to_camera_ = state_.transform;
    fov_ = d.number("fov", 90);
    if (const double radius = d.number("lensradius", 0); radius > 0) {
      camera_["aperture"] = radius;
      camera_["fdist"] = d.number("focaldistance", 1e6);
    }
  } else if (d.name == "Film") {
    width_ = d.number("xresolution", 1280);
    height_ = d.number("yresolution", 720);
    d.find("filename");
  } else if (d.name == "Sampler") {
    out_.json["sampler"] = {{"samples", static_cast<int>(d.number("pixelsamples", 16))}};
    if (d.find("seed")) out_.json["sampler"]["seed"] = static_cast<int>(d.number("seed", 0));
  } else if (d.name == "Integrator") {
    if (type != "path" && type != "volpath") note(d, "an integrator of type \"" + type + "\" has no counterpart here: a path tracer is taken");
    out_.json["integrator"] = {{"type", type == "volpath" ? "path tracer volumetric mis" : "path tracer mis"}, {"max bounces", static_cast<int>(d.number("maxdepth", 5))}};
  } else if (d.name == "MakeNamedMedium") {
    if (type.empty()) throw ImportError(d.file, d.line, "the medium has no name");
    if (d.text("type", "") != "homogeneous") {
      note(d, "only homogeneous media have a counterpart here: \"" + type + "\" becomes vacuum");
      for (const PbrtParameter& p : d.parameters) p.used = true;
    } else {
      out_.json["media"].push_back(medium_of(d));
      media_.insert(type);
    }
  } else if (d.name == "MediumInterface") {
    state_.inside = type;
    state_.outside = d.words.size() > 1 ? d.words[1] : "";
  } else if (d.name == "Material") {
    state_.material = material_of(d, type);
  } else if (d.name == "MakeNamedMaterial") {
    ImportJson m = material_of(d, d.text("type", ""));
    m["name"] = type;
    out_.json["materials"].push_back(m);
    materials_.insert(type);
  } else if (d.name == "NamedMaterial") {
    if (!materials_.count(type)) throw ImportError(d.file, d.line, "no material is called \"" + type + "\"");
    state_.material = type;
  } else if (d.name == "Texture") {
    textures_[type] = texture_of(d);
  } else {
    return false;
  }
  return true;
}

bool PbrtImport::apply_light(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  if (d.name == "AreaLightSource") {
    state_.emit = scaled(spectrum_of(d, "L", Role::Emission, 1.0), d.number("scale", 1));
    if (d.text("twosided", "false") == "true") note(d, "lamps shine from their front side only here: \"twosided\" was left out");
    return true;
  }
  if (d.name != "LightSource" || type != "infinite") return false;
  if (out_.json.contains("background")) note(d, "there is already a background, which this one replaces");
  if (const std::string file = d.text("filename", ""); !file.empty()) {
    note(d, "pbrt's maps are equal-area, ours of latitude and longitude: convert " + file);
    out_.json["background"] = {{"type", "environment"}, {"filename", relative_file(target_, folder_of(d), file)}, {"scale", d.number("scale", 1)}};
  } else {
    out_.json["background"] = scaled(spectrum_of(d, "L", Role::Emission, 1.0), d.number("scale", 1));
  }
  return true;
}

ImportJson PbrtImport::mesh_of(const PbrtDirective&, const std::string& name, ImportedMesh mesh) {
  const std::string file = target_.stem + "_meshes/" + name + "_" + std::to_string(out_.meshes.size()) + ".obj";
  out_.meshes.emplace_back(file, std::move(mesh));
  return {{"type", "mesh"}, {"filename", file}};
}

ImportJson PbrtImport::triangles_of(const PbrtDirective& d) {
  ImportedMesh mesh;
  const PbrtParameter *p = d.find("P"), *n = d.find("N"), *uv = d.find("uv"), *indices = d.find("indices");
  if (!p || p->numbers.size() % 3 != 0) throw ImportError(d.file, d.line, "the mesh has no \"point3 P\"");
  const auto triples = [](const std::vector<double>& v) {
    std::vector<std::array<double, 3>> all;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) all.push_back({v[i], v[i + 1], v[i + 2]});
    return all;
  };
  mesh.positions = triples(p->numbers);
  if (n && n->numbers.size() == p->numbers.size()) mesh.normals = triples(n->numbers);
  if (uv && uv->numbers.size() == 2 * mesh.positions.size())
    for (std::size_t i = 0; i + 1 < uv->numbers.size(); i += 2) mesh.uvs.push_back({uv->numbers[i], uv->numbers[i + 1]});
  std::vector<double> corners = indices ? indices->numbers : std::vector<double>{0, 1, 2};
  if (d.words.at(0) == "bilinearmesh") {
    // A patch's corners stand row by row; flat ones are two triangles.
    const std::vector<double> patches = indices ? corners : std::vector<double>{0, 1, 2, 3};
    corners.clear();
    for (std::size_t i = 0; i + 3 < patches.size(); i += 4)
      for (const std::size_t k : {0, 1, 3, 0, 3, 2}) corners.push_back(patches[i + k]);
    note(d, "bilinear patches become two triangles each");
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<int, 3> t;
    for (std::size_t k = 0; k < 3; k++) {
      t[k] = static_cast<int>(corners[i + k]);
      if (t[k] < 0 || static_cast<std::size_t>(t[k]) >= mesh.positions.size()) throw ImportError(d.file, d.line, "an index is out of range");
    }
    mesh.triangles.push_back(t);
  }
  if (mesh.triangles.empty()) throw ImportError(d.file, d.line, "the mesh has no triangles");
  return mesh_of(d, "mesh", std::move(mesh));
}

void PbrtImport::apply_shape(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  ImportJson surface;
  if (type == "sphere") {
    surface = {{"type", "sphere"}, {"radius", d.number("radius", 1)}};
  } else if (type == "trianglemesh" || type == "bilinearmesh") {
    surface = triangles_of(d);
  } else if (type == "plymesh") {
    const std::string file = d.text("filename", "");
    try {
      surface = mesh_of(d, std::filesystem::path(file).stem().string(), read_ply((std::filesystem::path(folder_of(d)) / file).string()));
    } catch (const std::runtime_error& error) {
      throw ImportError(d.file, d.line, file + " cannot be read as PLY: " + error.what());
    }
  } else {
    note(d, "a shape of type \"" + type + "\" has no counterpart here and was left out");
    for (const PbrtParameter& p : d.parameters) p.used = true;
    return;
  }
  if (const ImportJson t = transform_json(state_.transform); !t.is_null()) surface["transform"] = t;
  surface["material"] = state_.material;
  if (!state_.emit.is_null()) surface["emit"] = state_.emit;
  if (media_.count(state_.inside)) surface["inside"] = state_.inside;
  if (media_.count(state_.outside)) surface["outside"] = state_.outside;
  if (state_.reverse) surface["flip"] = true;
  out_.json["surfaces"].push_back(surface);
}

void PbrtImport::apply(const PbrtDirective& d) {
  const bool attribute = d.name == "AttributeBegin";
  if (attribute || d.name == "TransformBegin") {
    stack_.emplace_back(state_, attribute);
  } else if (d.name == "AttributeEnd" || d.name == "TransformEnd") {
    if (stack_.empty()) throw ImportError(d.file, d.line, d.name + " without its beginning");
    if (stack_.back().second)
      state_ = stack_.back().first;
    else
      state_.transform = stack_.back().first.transform;
    stack_.pop_back();
  } else if (d.name == "WorldBegin") {
    if (media_.count(state_.outside)) camera_["medium"] = state_.outside;
    state_.transform = Affine{};
  } else if (d.name == "ReverseOrientation") {
    state_.reverse = !state_.reverse;
  } else if (d.name == "Shape") {
    apply_shape(d);
  } else if (!apply_transform(d) && !apply_setting(d) && !apply_light(d)) {
    note(d, d.name + (d.words.empty() ? "" : " \"" + d.words[0] + "\"") + " has no counterpart here and was left out");
    return;
  }
  note_unused(d);
}

void PbrtImport::finish_camera() {
  if (!world_to_camera_) {
    out_.note(path_, 1, "there is no camera: it stands at (0, 0, 0) and looks along +z");
    world_to_camera_ = Affine{};
  }
  // pbrt's camera looks along +z in a left-handed frame. The angle is that of the shorter side.
  camera_["transform"] = transform_json(world_to_camera_->inverse() * scaling_of({1, 1, -1}));
  const double shorter = std::tan(fov_ * std::numbers::pi / 360);
  camera_["vfov"] = std::atan(height_ <= width_ ? shorter : shorter * height_ / width_) * 360 / std::numbers::pi;
  camera_["resolution"] = {width_, height_};
  out_.json["camera"] = camera_;
}

ImportedScene PbrtImport::run() {
  const std::vector<PbrtDirective> directives = read_pbrt(path_);
  bool world = false;
  for (const PbrtDirective& d : directives) world |= d.name == "WorldBegin";
  if (!world) throw ImportError(path_, 1, "this is no pbrt scene: it has no WorldBegin");
  out_.json["camera"] = ImportJson::object();
  for (const char* list : {"media", "materials", "surfaces"}) out_.json[list] = ImportJson::array();
  for (const PbrtDirective& d : directives) apply(d);
  finish_camera();
  return std::move(out_);
}

ImportedScene import_pbrt(const std::string& path, const ImportTarget& target) { return PbrtImport(path, target).run(); }

}  // namespace stokes
