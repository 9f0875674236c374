// A pbrt scene's frame: the graphics state, camera, film, lights and shapes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "import/media_around.h"
#include "import/pbrt_import.h"

namespace stokes {
namespace {

// pbrt's matrices stand column by column.
bool transposed_matrix_of(const std::vector<double>& m, Affine& out) {
  if (m.size() != 16) return false;
  std::vector<double> rows(16);
  for (std::size_t i = 0; i < 16; i++) rows[i % 4 * 4 + i / 4] = m[i];
  return matrix_of(rows, out);
}

}  // namespace

PbrtImport::PbrtImport(const std::string& path, ImportTarget target)
    : target_(std::move(target)), path_(path), folder_(std::filesystem::path(path).parent_path().string()) {}

void PbrtImport::note_unused(const PbrtDirective& d) {
  for (const PbrtParameter& p : d.parameters)
    // Those of an Attribute come again with every directive.
    if (!p.used && noted_.emplace(d.file, p.line, p.name).second) out_.note(d.file, p.line, "\"" + p.type + " " + p.name + "\" of " + d.name + " has no counterpart here and was left out");
}

bool PbrtImport::apply_transform(const PbrtDirective& d) {
  const std::vector<double>& n = d.numbers;
  const auto need = [&](std::size_t count) {
    if (n.size() != count) throw ImportError(d.file, d.line, d.name + " needs " + std::to_string(count) + " numbers");
  };
  const Affine before = state_.transform;
  Affine step;
  if (d.name == "ActiveTransform") {
    if (d.words.size() != 1 || (d.words[0] != "StartTime" && d.words[0] != "EndTime" && d.words[0] != "All")) throw ImportError(d.file, d.line, "ActiveTransform needs StartTime, EndTime or All");
    state_.at_start = d.words[0] != "EndTime";
    if (d.words[0] != "All") note(d, "nothing moves here: transforms of the shutter's closing are left out");
    return true;
  }
  if (d.name == "Identity") {
    state_.transform = Affine{};
  } else if (d.name == "CoordinateSystem" || d.name == "CoordSysTransform") {
    if (d.words.size() != 1) throw ImportError(d.file, d.line, d.name + " needs a name");
    const auto it = coordinate_systems_.find(d.words[0]);
    if (d.name == "CoordinateSystem") coordinate_systems_[d.words[0]] = state_.transform;
    else if (it == coordinate_systems_.end()) note(d, "no coordinate system is called \"" + d.words[0] + "\": nothing changes");
    else state_.transform = it->second;
    return true;
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
  if (!is_finite(state_.transform.translation()) || !(std::abs(state_.transform.determinant()) > 0)) throw ImportError(d.file, d.line, d.name + " makes the transform singular: it flattens space");
  if (!state_.at_start) {
    state_.transform = before;
    note(d, d.name + " of the shutter's closing was left out");
  }
  return true;
}

void PbrtImport::apply_camera(const PbrtDirective& d) {
  const bool orthographic = !d.words.empty() && d.words[0] == "orthographic";
  if (orthographic) camera_["type"] = "orthographic";
  if (!orthographic && (d.words.empty() || d.words[0] != "perspective")) note(d, "a camera of type \"" + (d.words.empty() ? "" : d.words[0]) + "\" has no counterpart here: a perspective one is taken");
  world_to_camera_ = state_.transform;
  coordinate_systems_["camera"] = state_.transform.inverse();
  camera_directive_ = &d;
  camera_medium_ = medium_named(d, state_.outside);
  if (!camera_medium_.empty()) camera_["medium"] = camera_medium_;
  fov_ = d.number("fov", 90);
  d.find("screenwindow");
  if (const double radius = d.number("lensradius", 0); radius > 0) {
    camera_["aperture"] = radius;
    camera_["fdist"] = d.number("focaldistance", 1e6);
  }
}

bool PbrtImport::apply_option(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  if (d.name == "Camera") {
    apply_camera(d);
  } else if (d.name == "Film") {
    width_ = d.number("xresolution", 1280);
    height_ = d.number("yresolution", 720);
    if (type != "rgb") note(d, "a film of type \"" + type + "\" has no counterpart here: R, G and B are taken (--spectral and --aov give the rest)");
    for (const char* name : {"filename", "savefp16"}) d.find(name);
  } else if (d.name == "Sampler") {
    out_.json["sampler"] = {{"samples", d.integer("pixelsamples", 16)}};
    if (d.find("seed")) out_.json["sampler"]["seed"] = d.integer("seed", 0);
  } else if (d.name == "Integrator") {
    if (type != "path" && type != "volpath") note(d, "an integrator of type \"" + type + "\" has no counterpart here: a path tracer is taken");
    out_.json["integrator"] = {{"type", type == "volpath" ? "path tracer volumetric mis" : "path tracer mis"}, {"max bounces", d.integer("maxdepth", 5)}};
    d.find("lightsampler");  // which has no say in the mean
  } else if (d.name == "WorldBegin") {
    state_.transform = Affine{};
    state_.at_start = true;
    coordinate_systems_["world"] = Affine{};
  } else {
    return false;
  }
  return true;
}

bool PbrtImport::apply_attribute(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  if (d.name == "ReverseOrientation") {
    state_.reverse = !state_.reverse;
  } else if (d.name == "MakeNamedMedium") {
    if (left_out_.count(type)) {
      note(d, "only homogeneous media have a counterpart here: \"" + type + "\" becomes vacuum");
      for (const PbrtParameter& p : d.parameters) p.used = true;
    } else {
      out_.json["media"].push_back(medium_of(d));
    }
  } else if (d.name == "MediumInterface") {
    state_.inside = type;
    state_.outside = d.words.size() > 1 ? d.words[1] : type;  // one name is for both sides
    medium_named(d, state_.inside), medium_named(d, state_.outside);
  } else if (d.name == "Material") {
    state_.material = material_of(d, type);
  } else if (d.name == "MakeNamedMaterial") {
    if (made_materials_.count(type)) throw ImportError(d.file, d.line, "there is already a material called \"" + type + "\"");
    ImportJson m = material_of(d, d.text("type", ""));
    m["name"] = type;
    out_.json["materials"].push_back(m);
    made_materials_.insert(type);
  } else if (d.name == "NamedMaterial") {
    if (!materials_.count(type)) throw ImportError(d.file, d.line, "no material is called \"" + type + "\"");
    state_.material = type;
  } else if (d.name == "Texture") {
    if (d.words.size() < 3) throw ImportError(d.file, d.line, "a texture needs a name, float or spectrum, and a type");
    textures_[d.words[1] + " " + type] = texture_of(d);
  } else {
    return false;
  }
  return true;
}

bool PbrtImport::apply_light(const PbrtDirective& d) {
  const std::string type = d.words.empty() ? "" : d.words[0];
  if (d.name == "AreaLightSource") {
    if (type != "diffuse") note(d, "an area light of type \"" + type + "\" has no counterpart here: a diffuse one is taken");
    state_.emit = scaled(spectrum_of(d, "L", Role::Emission, 1.0), d.number("scale", 1));
    if (d.text("twosided", "false") == "true") note(d, "lamps shine from their front side only here: \"twosided\" was left out");
    return true;
  }
  if (d.name != "LightSource" || type != "infinite") return false;
  if (out_.json.contains("background")) note(d, "there is already a background, which this one replaces");
  double scale = d.number("scale", 1);
  if (const std::string file = d.text("filename", ""); !file.empty()) {
    note(d, "pbrt's maps are equal-area, ours of latitude and longitude: convert " + file);
    if (!transform_json(state_.transform).is_null()) note(d, "the transform of the environment map was left out: \"rotate\" turns it about +y");
    out_.json["background"] = {{"type", "environment"}, {"filename", relative_file(target_, folder_, file)}, {"scale", scale}};
  } else {
    // The illuminance of a hemisphere of luminance 1 is pi.
    if (const double lux = d.number("illuminance", -1); lux > 0) scale *= lux / std::numbers::pi;
    out_.json["background"] = scaled(spectrum_of(d, "L", Role::Emission, 1.0), scale);
  }
  return true;
}

bool PbrtImport::apply_block(const PbrtDirective& d) {
  const bool attribute = d.name == "AttributeBegin";
  if (attribute || d.name == "TransformBegin") {
    if (stack_.size() >= kMostBlocks) throw ImportError(d.file, d.line, d.name + "s lie in each other more than " + std::to_string(kMostBlocks) + " deep");
    stack_.emplace_back(state_, attribute);
  } else if (d.name == "AttributeEnd" || d.name == "TransformEnd") {
    if (stack_.empty()) throw ImportError(d.file, d.line, d.name + " without its beginning");
    const auto& [saved, attributes] = stack_.back();
    if (attributes != (d.name == "AttributeEnd")) throw ImportError(d.file, d.line, d.name + " where an " + (attributes ? "Attribute" : "Transform") + "Begin is open");
    if (attributes)
      state_ = saved;
    else
      state_.transform = saved.transform;
    stack_.pop_back();
  } else {
    return false;
  }
  return true;
}

// Parameters that an Attribute gives to all directives of a kind: they stand where a directive does not have its own.
bool PbrtImport::apply_defaults(const PbrtDirective& d) {
  if (d.name != "Attribute") return false;
  const std::string kind = d.words.empty() ? "" : d.words[0];
  const char* kinds[] = {"shape", "light", "material", "medium", "texture"};
  if (std::find(std::begin(kinds), std::end(kinds), kind) == std::end(kinds)) throw ImportError(d.file, d.line, "Attribute needs shape, light, material, medium or texture");
  for (const PbrtParameter& p : d.parameters) {
    std::vector<PbrtParameter>& all = state_.defaults[kind];
    std::erase_if(all, [&](const PbrtParameter& other) { return other.name == p.name; });
    all.push_back(p);
    p.used = true;
  }
  return true;
}

PbrtDirective PbrtImport::with_defaults(PbrtDirective d) const {
  static const std::map<std::string, std::string> kinds = {{"Shape", "shape"}, {"LightSource", "light"}, {"AreaLightSource", "light"}, {"Material", "material"},
                                                           {"MakeNamedMaterial", "material"}, {"MakeNamedMedium", "medium"}, {"Texture", "texture"}};
  const auto kind = kinds.find(d.name);
  const auto defaults = kind == kinds.end() ? state_.defaults.end() : state_.defaults.find(kind->second);
  if (defaults == state_.defaults.end()) return d;
  for (const PbrtParameter& p : defaults->second)
    if (std::none_of(d.parameters.begin(), d.parameters.end(), [&](const PbrtParameter& own) { return own.name == p.name; })) d.parameters.push_back(p);
  return d;
}

void PbrtImport::apply(const PbrtDirective& given) {
  if (given.name == "Camera") return apply_option(given), note_unused(given);
  const PbrtDirective d = with_defaults(given);
  if (d.name == "Shape") {
    apply_shape(d);
  } else if (apply_defaults(d)) {
  } else if (!apply_block(d) && !apply_transform(d) && !apply_option(d) && !apply_attribute(d) && !apply_light(d) && !apply_object(d)) {
    note(d, d.name + (d.words.empty() ? "" : " \"" + d.words[0] + "\"") + " has no counterpart here and was left out");
    return;
  }
  note_unused(d);
}

std::string PbrtImport::medium_named(const PbrtDirective& d, const std::string& name) const {
  if (name.empty() || left_out_.count(name)) return "";
  if (!media_.count(name)) throw ImportError(d.file, d.line, "no medium is called \"" + name + "\"");
  return name;
}

void PbrtImport::finish_camera() {
  if (!world_to_camera_) {
    out_.note(path_, 1, "there is no camera: it stands at (0, 0, 0) and looks along +z");
    world_to_camera_ = Affine{};
  }
  // pbrt's camera looks along +z in a left-handed frame.
  camera_["transform"] = transform_json(world_to_camera_->inverse() * scaling_of({1, 1, -1}));
  if (camera_["transform"].is_null()) camera_.erase("transform");
  // The screen is 1 to either side along its shorter axis, which the angle is of; or what the window says.
  double top = height_ <= width_ ? 1 : height_ / width_;
  if (const PbrtParameter* window = camera_directive_ ? camera_directive_->find("screenwindow") : nullptr) {
    const std::vector<double>& w = window->numbers;
    const bool plain = w.size() == 4 && w[0] == -w[1] && w[2] == -w[3] && w[3] > 0 && std::abs(w[1] / w[3] * height_ / width_ - 1) < 1e-6;
    if (plain)
      top = w[3];
    else
      out_.note(camera_directive_->file, window->line, "a screenwindow that is off the middle, or not of the film's shape, was left out");
  }
  if (camera_.contains("type"))
    camera_["height"] = 2 * top;
  else
    camera_["vfov"] = std::atan(top * std::tan(fov_ * std::numbers::pi / 360)) * 360 / std::numbers::pi;
  camera_["resolution"] = {width_, height_};
  out_.json["camera"] = camera_;
}

// Names may be used before they are made.
void PbrtImport::collect_names(const std::vector<PbrtDirective>& directives) {
  for (const PbrtDirective& d : directives) {
    const std::string name = d.words.empty() ? "" : d.words[0];
    if (d.name == "MakeNamedMaterial") materials_.insert(name);
    if (d.name != "MakeNamedMedium") continue;
    if (name.empty() || media_.count(name) || left_out_.count(name)) throw ImportError(d.file, d.line, "a medium needs a new name");
    (d.text("type", "") == "homogeneous" ? media_ : left_out_).insert(name);
  }
}

ImportedScene PbrtImport::run() {
  const std::vector<PbrtDirective> directives = read_pbrt(path_, target_);
  bool world = false;
  for (const PbrtDirective& d : directives) world |= d.name == "WorldBegin";
  if (!world) throw ImportError(path_, 1, "this is no pbrt scene: it has no WorldBegin");
  out_.json["camera"] = ImportJson::object();
  out_.json["sampler"] = {{"samples", 16}};
  out_.json["integrator"] = {{"type", "path tracer volumetric mis"}, {"max bounces", 5}};
  for (const char* list : {"media", "materials", "surfaces"}) out_.json[list] = ImportJson::array();
  collect_names(directives);
  for (const PbrtDirective& d : directives) apply(d);
  if (!stack_.empty()) throw ImportError(path_, 1, "an AttributeBegin, TransformBegin or ObjectBegin has no end");
  finish_camera();
  name_media_around(out_, target_, camera_medium_);
  return std::move(out_);
}

ImportedScene import_pbrt(const std::string& path, const ImportTarget& target) { return PbrtImport(path, target).run(); }

}  // namespace stokes
