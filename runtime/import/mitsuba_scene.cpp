// A Mitsuba scene's frame: sensor, film, integrator, emitters, shapes and their transforms.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
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
    : target_(std::move(target)), xml_(path), folder_(std::filesystem::path(path).parent_path().string()) {}

Affine MitsubaImport::transform_of(const Node& node, const char* name) {
  Affine all;
  const Node transform = xml_.child(node, name);
  for (const Node& c : transform.children()) {
    if (c.type() != pugi::node_element) continue;
    const auto vector = [&](const char* key, Vec3d fallback) {
      const std::vector<double> v = xml_.numbers(c, xml_.attribute(c, key));
      if (v.size() == 1) return Vec3d{v[0], v[0], v[0]};
      return v.size() == 3 ? Vec3d{v[0], v[1], v[2]} : fallback;
    };
    const auto component = [&](const char* key, double fallback) {
      const std::vector<double> v = xml_.numbers(c, xml_.attribute(c, key));
      return v.size() == 1 ? v[0] : fallback;
    };
    const auto xyz = [&](double fallback) {
      return c.attribute("value") ? vector("value", {fallback, fallback, fallback}) : Vec3d{component("x", fallback), component("y", fallback), component("z", fallback)};
    };
    Affine step;
    if (is(c, "translate")) {
      step = translation_of(xyz(0));
    } else if (is(c, "scale")) {
      step = scaling_of(xyz(1));
    } else if (is(c, "rotate")) {
      const Vec3d axis = xyz(0);
      if (!(length(axis) > 0)) xml_.fail(c, "the axis of rotation is zero");
      step = rotation_of(component("angle", 0), axis);  // not normalised, as Mitsuba 3 does not: the same picture counts
    } else if (is(c, "lookat") || is(c, "look_at")) {
      step = look_at_of(vector("origin", {0, 0, 0}), vector("target", {0, 0, 1}), vector("up", {0, 1, 0}));
    } else if (is(c, "matrix")) {
      if (!matrix_of(xml_.numbers(c, xml_.attribute(c, "value")), step)) xml_.fail(c, "the matrix is no affine one of 16 numbers");
    } else {
      continue;  // noted as left out
    }
    xml_.use(c);
    all = step * all;
  }
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
  if (type != "perspective" && type != "thinlens") return;
  xml_.use(sensor);
  ImportJson camera = ImportJson::object();
  camera["resolution"] = {768, 576};
  for (const Node& film : sensor.children("film")) read_film(film, camera);
  // Mitsuba's camera looks along +z with +x to the left; ours along -z with +x to the right.
  camera["transform"] = transform_json(transform_of(sensor, "to_world") * scaling_of({-1, 1, -1}));
  camera["vfov"] = vertical_fov(sensor, camera["resolution"][0].get<double>(), camera["resolution"][1].get<double>());
  if (type == "thinlens") {
    camera["aperture"] = xml_.number(sensor, "aperture_radius", 0);
    camera["fdist"] = xml_.number(sensor, "focus_distance", 1);
  }
  for (const char* name : {"near_clip", "far_clip"}) xml_.child(sensor, name);  // nothing is clipped here
  if (const Node medium = xml_.child(sensor, "medium")) camera["medium"] = medium_of(follow(medium));
  for (const Node& sampler : sensor.children("sampler")) {
    xml_.use(sampler);
    out_.json["sampler"] = {{"samples", static_cast<int>(xml_.number(sampler, "sample_count", 4))}, {"seed", static_cast<int>(xml_.number(sampler, "seed", 0))}};
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
  const int depth = type == "direct" ? 2 : static_cast<int>(xml_.number(integrator, "max_depth", -1));
  ImportJson j = {{"type", type.starts_with("vol") ? "path tracer volumetric mis" : "path tracer mis"}, {"max bounces", depth < 0 ? kEndless : std::max(0, depth - 1)}};
  if (xml_.child(integrator, "rr_depth")) j["russian roulette"] = static_cast<int>(xml_.number(integrator, "rr_depth", 5));
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
  ImportJson j = {{"type", "environment"}, {"filename", relative_file(target_, folder_, xml_.text(emitter, "filename", ""))}};
  const auto turn = turn_about_y(transform_of(emitter, "to_world"));
  if (!turn) note(emitter, "an environment map is turned about +y only here: its to_world was left out");
  // Mitsuba's image begins where ours has its middle.
  j["rotate"] = std::fmod(180 + turn.value_or(0), 360.0);
  j["scale"] = xml_.number(emitter, "scale", 1);
  out_.json["background"] = j;
}

// The faces of [-1, 1]^3, each a quad that looks outwards.
ImportJson MitsubaImport::cube_of(const Affine& to_world) const {
  ImportJson group = {{"type", "group"}, {"children", ImportJson::array()}};
  if (const ImportJson t = transform_json(to_world); !t.is_null()) group["transform"] = t;
  const std::pair<double, Vec3d> turns[6] = {{0, {0, 1, 0}}, {180, {0, 1, 0}}, {90, {0, 1, 0}}, {-90, {0, 1, 0}}, {90, {1, 0, 0}}, {-90, {1, 0, 0}}};
  for (const auto& [degrees, axis] : turns) {
    ImportJson turned = ImportJson::array({{{"translate", {0, 0, 1}}}});
    if (degrees != 0) turned.push_back({{"rotate", {degrees, axis.x, axis.y, axis.z}}});
    group["children"].push_back({{"type", "quad"}, {"size", 2}, {"transform", turned}});
  }
  return group;
}

ImportJson MitsubaImport::mesh_of(const Node& shape, const Affine& to_world, bool ply) {
  const Node filename = xml_.child(shape, "filename");
  if (!filename) xml_.fail(shape, "the mesh names no file");
  const std::string file = xml_.attribute(filename, "value");
  ImportJson j = {{"type", "mesh"}};
  if (const Node facets = xml_.child(shape, "face_normals"); facets && xml_.attribute(facets, "value") == "true")
    note(facets, "normals at corners are taken from the file, where it has any");
  xml_.child(shape, "flip_tex_coords");
  if (ply) {
    try {
      const std::string name = target_.stem + "_meshes/" + std::filesystem::path(file).stem().string() + "_" + std::to_string(out_.meshes.size()) + ".obj";
      out_.meshes.emplace_back(name, read_ply((std::filesystem::path(folder_) / file).string()));
      j["filename"] = name;
    } catch (const std::runtime_error& error) {
      xml_.fail(filename, file + " cannot be read as PLY: " + error.what());
    }
  } else {
    j["filename"] = relative_file(target_, folder_, file);
  }
  if (const ImportJson t = transform_json(to_world); !t.is_null()) j["transform"] = t;
  return j;
}

ImportJson MitsubaImport::shape_of(const Node& shape, const Affine& to_world) {
  const std::string type = shape.attribute("type").value();
  if (type == "cube") return cube_of(to_world);
  if (type == "obj" || type == "ply") return mesh_of(shape, to_world, type == "ply");
  if (type == "rectangle" || type == "sphere") {
    ImportJson j = type == "sphere" ? ImportJson{{"type", "sphere"}, {"radius", xml_.number(shape, "radius", 1)}} : ImportJson{{"type", "quad"}, {"size", 2}};
    Affine place = to_world;
    if (const Node center = type == "sphere" ? xml_.child(shape, "center") : Node()) {
      std::vector<double> v = center.attribute("value") ? xml_.numbers(center, xml_.attribute(center, "value")) : std::vector<double>();
      if (v.empty())
        for (const char* key : {"x", "y", "z"}) v.push_back(center.attribute(key) ? xml_.numbers(center, xml_.attribute(center, key)).at(0) : 0);
      if (v.size() != 3) xml_.fail(center, "expected three numbers");
      place = place * translation_of({v[0], v[1], v[2]});
    }
    if (const ImportJson t = transform_json(place); !t.is_null()) j["transform"] = t;
    return j;
  }
  return nullptr;
}

void MitsubaImport::read_shape(const Node& shape) {
  xml_.use(shape);
  ImportJson surface = shape_of(shape, transform_of(shape, "to_world"));
  if (surface.is_null()) {
    note(shape, "a shape of type \"" + std::string(shape.attribute("type").value()) + "\" has no counterpart here and was left out");
    for (const Node& c : shape.children()) xml_.use(c);
    return;
  }
  ImportJson common = ImportJson::object();
  if (shape.attribute("id")) common["name"] = xml_.attribute(shape, "id");
  for (const Node& emitter : shape.children("emitter"))
    if (std::strcmp(emitter.attribute("type").value(), "area") == 0) {
      xml_.use(emitter);
      common["emit"] = spectrum_child(emitter, "radiance", Role::Emission, 1.0);
    }
  common["material"] = shape_material(shape, common.contains("emit"));
  if (const ImportJson inside = shape_medium(shape, "interior"); !inside.is_null()) common["inside"] = inside;
  if (const ImportJson outside = shape_medium(shape, "exterior"); !outside.is_null()) common["outside"] = outside;
  if (xml_.number(shape, "flip_normals", 0) != 0) common["flip"] = true;
  if (surface["type"] == "group")
    for (ImportJson& face : surface["children"]) face.update(common);
  else
    surface.update(common);
  out_.json["surfaces"].push_back(surface);
}

ImportedScene MitsubaImport::run() {
  const std::string version = xml_.root().attribute("version").value();
  if (version.starts_with("0.")) note(xml_.root(), "version " + version + " spells many names otherwise; Mitsuba 3 upgrades such files");
  for (const Node& node : xml_.root().children())
    if (node.attribute("id")) by_id_[xml_.attribute(node, "id")] = node;
  out_.json["camera"] = ImportJson::object();
  for (const char* list : {"media", "materials", "surfaces"}) out_.json[list] = ImportJson::array();
  for (const Node& node : xml_.root().children()) {
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
  for (const Node& node : xml_.root().children()) {
    if (is(node, "sensor")) read_sensor(node);
    if (is(node, "integrator")) read_integrator(node);
    if (is(node, "emitter")) read_emitter(node);
    if (is(node, "shape")) read_shape(node);
  }
  if (out_.json["camera"].empty()) note(xml_.root(), "there is no perspective sensor: the camera stands at (0, 0, 0) and looks along -z");
  xml_.note_the_rest(out_);
  std::stable_sort(out_.notes.begin(), out_.notes.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  return std::move(out_);
}

ImportedScene import_mitsuba(const std::string& path, const ImportTarget& target) { return MitsubaImport(path, target).run(); }

}  // namespace stokes
