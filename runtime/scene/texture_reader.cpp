// The types of textures, one function each.
#include "scene/texture_reader.h"

#include <algorithm>
#include <functional>
#include <map>

#include "scene/image_file.h"
#include "scene/memory_error.h"
#include "scene/spectrum_reader.h"
#include "scene/transform_reader.h"

namespace stokes {
namespace {

struct Leaf {
  SpectrumRole role;
  Range range;
};
using Type = std::function<void(ReadContext&, const JsonObject&, const Leaf&, TextureDescription&)>;

ColorSource color_or(ReadContext& context, const JsonObject& o, const char* key, const Leaf& leaf, double fallback) {
  if (const auto node = o.find(key)) return read_color(context, *node, leaf.role, leaf.range);
  return {make_number_spectrum(fallback, o.node().pointer()), nullptr};
}

// Noise mixes two spectra; a texture inside it has no place on the device.
SpectrumPtr plain_color_or(ReadContext& context, const JsonObject& o, const char* key, const Leaf& leaf, double fallback) {
  const ColorSource c = color_or(context, o, key, leaf, fallback);
  if (c.texture) o.require(key).fail("a marble's colours are spectra, not textures");
  return c.spectrum;
}

void read_checker(ReadContext& context, const JsonObject& o, const Leaf& leaf, TextureDescription& t) {
  t.kind = TextureKind::Checker;
  t.a = color_or(context, o, "even", leaf, 0);
  t.b = color_or(context, o, "odd", leaf, 1);
  t.scale = o.number("scale", 1, kPositive);
}

void read_marble(ReadContext& context, const JsonObject& o, const Leaf& leaf, TextureDescription& t) {
  t.kind = TextureKind::Marble;
  t.a.spectrum = plain_color_or(context, o, "base", leaf, 1);
  t.b.spectrum = plain_color_or(context, o, "veins", leaf, 0);
  t.scale = o.number("scale", 1);
}

void read_image_texture(ReadContext& context, const JsonObject& o, const Leaf&, TextureDescription& t) {
  t.kind = TextureKind::Image;
  const JsonNode filename = o.require("filename");
  t.image = read_image(context, filename, o.boolean("raw", false));
  t.filename = filename.string();
  t.scale = o.number("scale", 1, kNotNegative);
  const std::string wrap = o.string("wrap", "repeat"), filter = o.string("filter", "bilinear");
  if (wrap != "repeat" && wrap != "clamp") o.require("wrap").fail("expected \"repeat\" or \"clamp\", not \"" + wrap + "\"");
  if (filter != "bilinear" && filter != "nearest") o.require("filter").fail("expected \"bilinear\" or \"nearest\", not \"" + filter + "\"");
  t.clamp = wrap == "clamp";
  t.nearest = filter == "nearest";
}

void read_wireframe(ReadContext& context, const JsonObject& o, const Leaf& leaf, TextureDescription& t) {
  t.kind = TextureKind::Wireframe;
  t.a = color_or(context, o, "base", leaf, 0.8);
  t.b = color_or(context, o, "wire", leaf, 0);
  t.parameter = o.number("thickness", 0.05, kNotNegative);
}

void read_fresnel(ReadContext&, const JsonObject& o, const Leaf&, TextureDescription& t) {
  t.kind = TextureKind::Fresnel;
  t.parameter = o.number("ior", 1.5, kPositive);
}

RegionShapeDescription read_shape(const JsonNode& node) {
  const JsonObject o(node, "a region's shape", {"sphere", "box", "capsule", "radius"});
  if (o.has("sphere") + o.has("box") + o.has("capsule") != 1) node.fail("a shape is one of \"sphere\", \"box\" and \"capsule\"");
  RegionShapeDescription shape;
  const auto two_points = [&](const JsonNode& points) {
    if (!points.is_array() || points.size() != 2) points.fail("expected two points");
    shape.a = points[0].vector();
    shape.b = points[1].vector();
  };
  if (const auto center = o.find("sphere")) {
    shape.a = shape.b = center->vector();
  } else if (const auto corners = o.find("box")) {
    shape.kind = RegionShapeDescription::Kind::Box;
    two_points(*corners);
    const Vec3d low = min(shape.a, shape.b), high = max(shape.a, shape.b);
    shape.a = low;
    shape.b = high;
    if (const auto radius = o.find("radius")) radius->fail_at_key("a box has no radius");
  } else {
    shape.kind = RegionShapeDescription::Kind::Capsule;
    two_points(o.require("capsule"));
  }
  if (shape.kind != RegionShapeDescription::Kind::Box) shape.radius = o.require("radius").number(kPositive);
  return shape;
}

void read_region(ReadContext&, const JsonObject& o, const Leaf&, TextureDescription& t) {
  t.kind = TextureKind::Region;
  const JsonNode shapes = o.require("shapes");
  if (!shapes.is_array()) shapes.fail_type("an array of shapes");
  for (std::size_t i = 0; i < shapes.size(); i++) t.shapes.push_back(read_shape(shapes[i]));
  if (t.shapes.empty()) shapes.fail("a region needs at least one shape");
}

void read_mesh_mask(ReadContext&, const JsonObject& o, const Leaf&, TextureDescription& t) {
  t.kind = TextureKind::VertexMask;
  t.mask_name = o.require("name").string();
}

struct TypeEntry {
  std::vector<std::string> keys;
  Type read;
  bool scalar;  // its value is one number, so it cannot stand for a colour
};

const std::map<std::string, TypeEntry>& types() {
  static const std::map<std::string, TypeEntry> table = {
      {"checker", {{"even", "odd", "scale"}, read_checker, false}},
      {"marble", {{"base", "veins", "scale"}, read_marble, false}},
      {"image", {{"filename", "raw", "scale", "wrap", "filter"}, read_image_texture, false}},
      {"wireframe", {{"base", "wire", "thickness"}, read_wireframe, false}},
      {"fresnel", {{"ior"}, read_fresnel, true}},
      {"region", {{"shapes"}, read_region, true}},
      {"mesh mask", {{"name"}, read_mesh_mask, true}},
  };
  return table;
}

std::vector<std::string> type_names() {
  std::vector<std::string> names = spectrum_types();
  for (const auto& type : types()) names.push_back(type.first);
  return names;
}

// Lookup transforms map world points to texture space; the description keeps the inverse.
Affine read_lookup(const JsonObject& o) {
  const auto mapping = o.find("mapping3d") ? o.find("mapping3d") : o.find("mapping");
  const auto direct = o.find("xform") ? o.find("xform") : o.find("transform");
  if (mapping && direct) mapping->fail_at_key("the texture already has a transform");
  if (direct) return read_transform(*direct).inverse();
  if (!mapping) return {};
  const JsonObject m(*mapping, "a texture mapping", {"type", "transform"});
  // darts' first scenes call it "identity", as pbrt does: the point itself, by the transform.
  if (const std::string type = m.string("type", "transform"); type != "transform" && type != "identity")
    m.require("type").fail("the only mapping is \"transform\", not \"" + type + "\"");
  const auto transform = m.find("transform");
  return transform ? read_transform(*transform).inverse() : Affine{};
}

TexturePtr read_texture(ReadContext& context, const JsonNode& node, const Leaf& leaf) {
  const std::string type = type_of(node, "a texture");
  const TypeEntry& entry = types().at(type);
  std::vector<std::string> keys = entry.keys;
  for (const char* key : {"type", "name", "xform", "transform", "mapping3d", "mapping"}) keys.push_back(key);
  const JsonObject o(node, "a texture of type \"" + type + "\"", keys);
  auto t = std::make_shared<TextureDescription>();
  t->pointer = node.pointer();
  entry.read(context, o, leaf, *t);
  t->transform = read_lookup(o);
  return t;
}

}  // namespace

std::shared_ptr<const ImagePixels> read_image(ReadContext& context, const JsonNode& filename, bool raw) {
  const std::string path = context.file_path(filename, FileSort::Image);
  try {
    return std::make_shared<ImagePixels>(read_image_file(path, raw, context.limits));
  } catch (const OutOfMemory& error) {
    throw SceneMemoryError(filename.source(), filename.pointer(), error.what());
  } catch (const std::runtime_error& error) {
    filename.fail(path + " cannot be read as an image: " + error.what());
  }
}

ColorSource read_color(ReadContext& context, const JsonNode& node, SpectrumRole role, const Range& range) {
  if (!node.is_object()) return {read_spectrum(context, node, role, range), nullptr};
  const std::string type = type_of(node, "a colour");
  if (is_spectrum_type(type)) return {read_spectrum(context, node, role, range), nullptr};
  const auto texture = types().find(type);
  if (texture == types().end())
    node.child("type").fail("neither a spectrum nor a texture has the type \"" + node.child("type").string() + "\"" +
                            did_you_mean(type, type_names()));
  if (texture->second.scalar) node.child("type").fail("a texture of type \"" + type + "\" is a number, not a colour");
  return {nullptr, read_texture(context, node, {role, range})};
}

AmountSource read_amount(ReadContext& context, const JsonNode& node) {
  if (node.is_number()) return {node.number(kUnitInterval), nullptr};
  const std::string type = type_of(node, "an amount");
  if (type == "constant") {
    const JsonObject o(node, "a constant", {"type", "value", "color"});
    return {o.require(o.has("color") ? "color" : "value").number(kUnitInterval), nullptr};
  }
  if (!types().count(type))
    node.child("type").fail("no texture has the type \"" + node.child("type").string() + "\"" + did_you_mean(type, type_names()));
  return {std::nullopt, read_texture(context, node, {SpectrumRole::Reflectance, kUnitInterval})};
}

}  // namespace stokes
