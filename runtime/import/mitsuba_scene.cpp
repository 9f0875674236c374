// A Mitsuba scene's frame: sensor, film, integrator, emitters and transforms.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "import/mitsuba_import.h"

namespace stokes {
namespace {

constexpr int kEndless = 1'000'000;

bool is(const pugi::xml_node& node, const char* tag) { return std::strcmp(node.name(), tag) == 0; }

// Degrees about +y that a rotation turns by, when that is all it does.
std::optional<double> turn_about_y(const Affine& a) {
  const double degrees = std::atan2(a.m[2], a.m[0]) * 180 / std::numbers::pi;
  const Affine plain = rotation_of(degrees, {0, 1, 0});
  for (std::size_t i = 0; i < 12; i++)
    if (i % 4 != 3 && std::abs(plain.m[i] - a.m[i]) > 1e-6) return std::nullopt;
  return degrees;
}

}  // namespace

MitsubaImport::MitsubaImport(const std::string& path, ImportTarget target)
    : target_(std::move(target)), xml_(path, target_) {}

// One step of a transform.
Affine MitsubaImport::step_of(const Node& c) {
  const auto vector = [&](const char* key, double fallback) {
    const std::vector<double> v = xml_.numbers(c, xml_.attribute(c, key));
    if (v.size() != 3 && v.size() != 1 && c.attribute(key)) xml_.fail(c, std::string("expected one number or three for ") + key);
    if (v.empty()) return Vec3d{fallback, fallback, fallback};
    return v.size() == 1 ? Vec3d{v[0], v[0], v[0]} : Vec3d{v[0], v[1], v[2]};
  };
  const auto component = [&](const char* key, double fallback) {
    const std::vector<double> v = xml_.numbers(c, xml_.attribute(c, key));
    if (v.size() != 1 && c.attribute(key)) xml_.fail(c, std::string("expected a number for ") + key);
    return v.empty() ? fallback : v[0];
  };
  const auto xyz = [&](double fallback) { return c.attribute("value") ? vector("value", fallback) : Vec3d{component("x", fallback), component("y", fallback), component("z", fallback)}; };
  if (is(c, "translate")) return translation_of(xyz(0));
  if (is(c, "scale")) return scaling_of(xyz(1));
  if (is(c, "rotate")) {
    const Vec3d axis = xyz(0);
    if (!(length(axis) > 0)) xml_.fail(c, "the axis of rotation is zero");
    return rotation_of(component("angle", 0), axis);  // not normalised, as Mitsuba 3 does not: the same picture counts
  }
  if (is(c, "lookat") || is(c, "look_at")) {
    const Vec3d origin = vector("origin", 0), target = vector("target", 0), up = c.attribute("up") ? vector("up", 0) : Vec3d{0, 1, 0};
    const Affine look = look_at_of(origin, target, up);
    if (!is_finite(look.column(0)) || !is_finite(look.column(2))) xml_.fail(c, "the target is the origin, or lies in the direction of up");
    return look;
  }
  std::vector<double> m = xml_.numbers(c, xml_.attribute(c, "value"));
  if (m.size() == 9) m = {m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, 0, 0, 0, 1};
  Affine step;
  if (!matrix_of(m, step)) xml_.fail(c, "the matrix is no affine one of 9 or 16 numbers");
  return step;
}

Affine MitsubaImport::transform_of(const Node& node, const char* name) {
  Affine all;
  const Node transform = xml_.child(node, name);
  for (const Node& c : transform.children()) {
    const char* steps[] = {"translate", "scale", "rotate", "lookat", "look_at", "matrix"};
    if (std::none_of(std::begin(steps), std::end(steps), [&](const char* step) { return is(c, step); })) continue;  // noted as left out
    xml_.use(c);
    all = step_of(c) * all;
  }
  if (transform && !(std::abs(all.determinant()) > 0)) xml_.fail(transform, "the transform is singular: it flattens space");
  return all;
}

double MitsubaImport::vertical_fov(const Node& sensor, double width, double height) {
  const Node angle = xml_.child(sensor, "fov"), focal = xml_.child(sensor, "focal_length");
  if (angle && focal) xml_.fail(sensor, "there are both a fov and a focal_length");
  std::string axis = xml_.text(sensor, "fov_axis", "x");
  double tangent = 0;  // of half the angle along the axis
  if (angle) {
    tangent = std::tan(xml_.number(sensor, "fov", 0) * std::numbers::pi / 360);
  } else {
    // Of a film of 36 by 24 mm, measured along the diagonal; 50mm where nothing is said.
    std::string length = focal ? xml_.attribute(focal, "value") : "50mm";
    if (length.ends_with("mm")) length.resize(length.size() - 2);
    const std::vector<double> v = xml_.numbers(focal ? focal : sensor, length);
    if (v.size() != 1) xml_.fail(focal, "expected a length such as 50mm");
    tangent = std::hypot(36, 24) / 2 / v[0];
    axis = "diagonal";
  }
  if (!(tangent > 0)) xml_.fail(angle ? angle : focal, "the angle of view lies outside 0 to 180 degrees");
  if (axis == "smaller") axis = height < width ? "y" : "x";
  if (axis == "larger") axis = height < width ? "x" : "y";
  if (axis != "x" && axis != "y" && axis != "diagonal") xml_.fail(sensor, "fov_axis is none of x, y, diagonal, smaller and larger");
  const double extent = axis == "x" ? width : axis == "y" ? height : std::hypot(width, height);
  return std::atan(tangent * height / extent) * 360 / std::numbers::pi;
}

void MitsubaImport::read_film(const Node& film, ImportJson& camera) {
  xml_.use(film);
  camera["resolution"] = {xml_.number(film, "width", 768), xml_.number(film, "height", 576)};
  for (const Node& filter : film.children("rfilter")) {
    xml_.use(filter);
    if (std::strcmp(filter.attribute("type").value(), "box") != 0)
      note(filter, "pixels are boxes here: the filter \"" + std::string(filter.attribute("type").value()) + "\" was left out");
  }
  for (const char* name : {"file_format", "pixel_format", "component_format"}) xml_.child(film, name);
}

void MitsubaImport::read_sensor(const Node& sensor) {
  const std::string type = sensor.attribute("type").value();
  if (type != "perspective" && type != "thinlens" && type != "orthographic") return;
  xml_.use(sensor);
  if (!out_.json["camera"].empty()) {
    note(sensor, "only the first sensor is taken: this one was left out");
    for (const Node& c : sensor.children()) xml_.use(c);
    return;
  }
  ImportJson camera = ImportJson::object();
  camera["resolution"] = {768, 576};
  for (const Node& film : sensor.children("film")) read_film(film, camera);
  // Mitsuba's camera looks along +z with +x to the left; ours along -z with +x to the right.
  camera["transform"] = transform_json(transform_of(sensor, "to_world") * scaling_of({-1, 1, -1}));
  const double width = camera["resolution"][0].get<double>(), height = camera["resolution"][1].get<double>();
  if (type == "orthographic") {
    camera["type"] = "orthographic";
    camera["height"] = 2 * height / width;
  } else {
    camera["vfov"] = vertical_fov(sensor, width, height);
  }
  if (type == "thinlens") {
    camera["aperture"] = xml_.number(sensor, "aperture_radius", 0);
    camera["fdist"] = xml_.number(sensor, "focus_distance", 1);
  }
  for (const char* name : {"near_clip", "far_clip"}) xml_.child(sensor, name);  // nothing is clipped here
  if (const ImportJson medium = shape_medium(sensor, "medium"); !medium.is_null()) {
    camera["medium"] = medium;
    if (medium.is_string()) camera_medium_ = medium;
  }
  for (const Node& sampler : sensor.children("sampler")) {
    xml_.use(sampler);
    out_.json["sampler"] = {{"samples", xml_.integer(sampler, "sample_count", 4)}, {"seed", xml_.integer(sampler, "seed", 0)}};
  }
  if (camera["transform"].is_null()) camera.erase("transform");
  out_.json["camera"] = camera;
}

void MitsubaImport::read_integrator(const Node& integrator) {
  const std::string type = integrator.attribute("type").value();
  xml_.use(integrator);
  if (type != "path" && type != "volpath" && type != "volpathmis" && type != "direct") {
    note(integrator, "an integrator of type \"" + type + "\" has no counterpart here: a path tracer is taken");
    return;
  }
  const int depth = type == "direct" ? 2 : xml_.integer(integrator, "max_depth", -1);
  ImportJson j = {{"type", type.starts_with("vol") ? "path tracer volumetric mis" : "path tracer mis"}, {"max bounces", depth < 0 ? kEndless : std::clamp(depth - 1, 0, kEndless)}};
  if (xml_.child(integrator, "rr_depth")) j["russian roulette"] = xml_.integer(integrator, "rr_depth", 5);
  out_.json["integrator"] = j;
}

void MitsubaImport::read_emitter(const Node& emitter) {
  const std::string type = emitter.attribute("type").value();
  if (type != "constant" && type != "envmap") return;
  xml_.use(emitter);
  if (out_.json.contains("background")) note(emitter, "there is already a background, which this one replaces");
  if (type == "constant") {
    out_.json["background"] = spectrum_child(emitter, "radiance", Role::Emission, 1.0);
    return;
  }
  const Node filename = xml_.child(emitter, "filename");
  if (!filename) xml_.fail(emitter, "the environment map names no file");
  ImportJson j = {{"type", "environment"}, {"filename", existing_file(filename, xml_.attribute(filename, "value"))}};
  const auto turn = turn_about_y(transform_of(emitter, "to_world"));
  if (!turn) note(emitter, "an environment map is turned about +y only here: its to_world was left out");
  // Mitsuba's image begins where ours has its middle.
  j["rotate"] = std::fmod(180 + turn.value_or(0), 360.0);
  j["scale"] = xml_.number(emitter, "scale", 1);
  out_.json["background"] = j;
}

// Media and materials with an id, in their order.
void MitsubaImport::read_named() {
  for (const Node& node : xml_.elements()) {
    const std::string id = xml_.attribute(node, "id");
    if (is(node, "medium") && !id.empty()) {
      if (ImportJson m = medium_of(node); !m.is_null()) {
        m["name"] = id;
        out_.json["media"].push_back(m);
        media_.insert(id);
      }
    }
    if (is(node, "bsdf") && !id.empty()) {
      ImportJson m = material_of(node);
      if (m.is_string()) continue;
      m["name"] = id;
      out_.json["materials"].push_back(m);
      materials_.insert(id);
    }
    if (is(node, "texture") || is(node, "spectrum")) xml_.use(node);
  }
}

ImportedScene MitsubaImport::run() {
  const std::string version = xml_.root().attribute("version").value();
  if (version.starts_with("0.")) note(xml_.root(), "version " + version + " spells many names otherwise; Mitsuba 3 upgrades such files");
  out_.json["camera"] = ImportJson::object();
  for (const char* list : {"media", "materials", "surfaces"}) out_.json[list] = ImportJson::array();
  read_named();
  for (const Node& node : xml_.elements()) {
    if (is(node, "sensor")) read_sensor(node);
    if (is(node, "integrator")) read_integrator(node);
    if (is(node, "emitter")) read_emitter(node);
    if (is(node, "shape")) read_shape(node);
  }
  if (out_.json["camera"].empty()) note(xml_.root(), "there is no sensor that has a counterpart: the camera stands at (0, 0, 0) and looks along -z");
  name_media_around(out_, target_, camera_medium_);
  xml_.note_the_rest(out_);
  std::stable_sort(out_.notes.begin(), out_.notes.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  return std::move(out_);
}

ImportedScene import_mitsuba(const std::string& path, const ImportTarget& target) { return MitsubaImport(path, target).run(); }

}  // namespace stokes
