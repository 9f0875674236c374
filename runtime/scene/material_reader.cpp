// The types of materials, one function each.
#include "scene/material_reader.h"

#include <algorithm>
#include <functional>
#include <map>

#include "scene/skin_reader.h"
#include "scene/spectrum_reader.h"
#include "scene/texture_reader.h"

namespace stokes {
namespace {

using Type = std::function<void(ReadContext&, const JsonObject&, MaterialDescription&)>;

void read_albedo(ReadContext& context, const JsonObject& o, MaterialDescription& m, const char* key, double fallback) {
  if (const auto node = o.find(key))
    m.albedo = read_color(context, *node, SpectrumRole::Reflectance, kUnitInterval);
  else
    m.albedo.spectrum = make_number_spectrum(fallback, o.node().pointer());
}

// darts lets a texture stand for a roughness; only a constant one can be used here.
double read_constant_amount(ReadContext& context, const JsonObject& o, const char* key, double fallback) {
  const auto node = o.find(key);
  if (!node) return fallback;
  if (node->is_number()) return node->number(kNotNegative);
  const AmountSource amount = read_amount(context, *node);
  if (!amount.constant) node->fail("a texture cannot stand for the " + std::string(key));
  return *amount.constant;
}

void read_lambertian(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Lambertian;
  read_albedo(context, o, m, "albedo", 0.5);
}

void read_metal(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Metal;
  read_albedo(context, o, m, "albedo", 0.8);
  m.roughness = std::min(1.0, read_constant_amount(context, o, "roughness", 0));  // as darts
}

void read_conductor(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Conductor;
  m.eta = read_spectrum(context, o.require("eta"), SpectrumRole::Index, kPositive);
  m.k = read_spectrum(context, o.require("k"), SpectrumRole::Index, kNotNegative);
  m.alpha = o.number("alpha", 0, kUnitInterval);
}

void read_dielectric(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Dielectric;
  const auto ior = o.find("ior");
  m.ior = ior ? read_spectrum(context, *ior, SpectrumRole::Index, kPositive) : make_number_spectrum(1.5, o.node().pointer());
  m.alpha = o.number("alpha", 0, kUnitInterval);
  if (const auto albedo = o.find("scatter_albedo")) m.albedo = read_color(context, *albedo, SpectrumRole::Reflectance, kUnitInterval);
}

template <MaterialKind kKind>
void read_lobe(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = kKind;
  read_albedo(context, o, m, "albedo", 0.5);
  m.exponent = o.number("exponent", 1, kNotNegative);
}

void read_diffuse_light(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::DiffuseLight;
  m.emit = make_number_spectrum(1, o.node().pointer());
  if (const auto emit = o.find("emit")) {
    const ColorSource color = read_color(context, *emit, SpectrumRole::Emission, kNotNegative);
    m.emit = color.spectrum;
    m.emit_texture = color.texture;
  }
}

void read_uv_light(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  read_diffuse_light(context, o, m);
  if (!o.has("emit")) {
    auto lamp = std::make_shared<Spectrum>();
    lamp->kind = SpectrumKind::Gaussian;
    lamp->value = 1;
    lamp->a = 365;
    lamp->b = 10;
    lamp->pointer = o.node().pointer();
    m.emit = lamp;
  }
  if (const auto power = o.find("power")) {
    if (m.emit_texture) power->fail_at_key("a textured light has no power: scale its texture");
    m.power = power->number(kNotNegative);
  }
}

void read_fluorescent(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::DiffuseFluorescent;
  read_albedo(context, o, m, "albedo", 0);
  const auto dyes = o.find("dyes");
  if (!dyes) {
    m.dyes.push_back(read_dye(context, o, false));
    return;
  }
  for (const char* key : {"absorption", "emission", "yield", "yield_type", "concentration", "stokes"})
    if (const auto value = o.find(key)) value->fail_at_key("with \"dyes\" this key belongs into each dye");
  m.dyes = read_dyes(context, *dyes, false);
}

void read_reradiation(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Reradiation;
  const JsonNode filename = o.require("filename");
  m.matrix = read_reradiation_file(filename, context.file_path(filename, FileSort::Table));
}

void set_amount(MaterialDescription& m, const AmountSource& amount) {
  m.amount = amount.constant;
  m.amount_texture = amount.texture;
}

void read_parts(ReadContext& context, const JsonObject& o, MaterialDescription& m, const char* a, const char* b) {
  m.a = read_material(context, o.require(a));
  m.b = read_material(context, o.require(b));
  context.add_part(o.require(a), &m, m.a.get(), &InputLimits::materials);
  context.add_part(o.require(b), &m, m.b.get(), &InputLimits::materials);
}

void read_blend(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Blend;
  read_parts(context, o, m, "a", "b");
  const auto amount = o.find("amount");
  set_amount(m, amount ? read_amount(context, *amount) : AmountSource{0.5, nullptr});
}

// darts reads this index as a texture; only a constant one can be used here.
double read_plain_ior(const JsonObject& o) {
  const auto node = o.find("ior");
  if (!node) return 1.5;
  if (node->is_number() || type_of(*node, "an index of refraction") != "constant") return node->number(kPositive);
  const JsonObject constant(*node, "a constant", {"type", "value", "color"});
  return constant.require(constant.has("color") ? "color" : "value").number(kPositive);
}

// darts' older spelling of a blend whose amount is a fresnel texture.
void read_fresnel_blend(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Blend;
  read_parts(context, o, m, "refr", "refl");
  auto fresnel = std::make_shared<TextureDescription>();
  fresnel->kind = TextureKind::Fresnel;
  fresnel->parameter = read_plain_ior(o);
  fresnel->pointer = o.node().pointer();
  m.amount_texture = fresnel;
}

void read_painted(ReadContext& context, const JsonObject& o, MaterialDescription& m) {
  m.kind = MaterialKind::Blend;
  read_parts(context, o, m, "base", "paint");
  set_amount(m, read_amount(context, o.require("mask")));
}

struct TypeEntry {
  std::vector<std::string> keys;
  Type read;
};

const std::map<std::string, TypeEntry>& types() {
  static const std::vector<std::string> dye = {"absorption", "emission", "yield", "yield_type", "concentration", "stokes"};
  static const std::map<std::string, TypeEntry> table = [] {
    std::map<std::string, TypeEntry> t = {
        {"lambertian", {{"albedo"}, read_lambertian}},
        {"metal", {{"albedo", "roughness"}, read_metal}},
        {"conductor", {{"eta", "k", "alpha"}, read_conductor}},
        {"dielectric", {{"ior", "alpha", "scatter_albedo"}, read_dielectric}},
        {"interface", {{}, [](ReadContext&, const JsonObject&, MaterialDescription& m) { m.kind = MaterialKind::Interface; }}},
        {"phong", {{"albedo", "exponent"}, read_lobe<MaterialKind::Phong>}},
        {"blinn phong", {{"albedo", "exponent"}, read_lobe<MaterialKind::BlinnPhong>}},
        {"diffuse light", {{"emit"}, read_diffuse_light}},
        {"uv light", {{"emit", "power"}, read_uv_light}},
        {"diffuse fluorescent", {{"albedo", "dyes"}, read_fluorescent}},
        {"reradiation", {{"filename"}, read_reradiation}},
        {"blend", {{"a", "b", "amount"}, read_blend}},
        {"fresnel blend", {{"ior", "refl", "refr"}, read_fresnel_blend}},
        {"painted", {{"base", "paint", "mask"}, read_painted}},
        {"skin", {skin_keys(), read_skin}},
    };
    auto& keys = t.at("diffuse fluorescent").keys;
    keys.insert(keys.end(), dye.begin(), dye.end());
    return t;
  }();
  return table;
}

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const auto& type : types()) {
    names.push_back(type.first);
    std::replace(names.back().begin(), names.back().end(), ' ', '_');
  }
  return names;
}

MaterialPtr read_inline(ReadContext& context, const JsonNode& node) {
  const std::string type = type_of(node, "a material");
  const auto entry = types().find(type);
  if (entry == types().end()) {
    const JsonNode name = node.child("type");
    name.fail("no material has the type \"" + name.string() + "\"" + did_you_mean(name.string(), type_names()));
  }
  std::vector<std::string> keys = entry->second.keys;
  keys.insert(keys.end(), {"type", "name"});
  const JsonObject o(node, "a material of type \"" + node.child("type").string() + "\"", keys);
  auto m = std::make_shared<MaterialDescription>();
  m->pointer = node.pointer();
  m->name = o.string("name", "");
  entry->second.read(context, o, *m);
  return m;
}

}  // namespace

MaterialPtr read_material(ReadContext& context, const JsonNode& node) {
  if (node.is_string()) return context.materials.resolve(node);
  if (!node.is_object()) node.fail_type("a material or the name of one");
  return read_inline(context, node);
}

void read_named_materials(ReadContext& context, const JsonNode& list) {
  if (!list.is_array()) list.fail_type("an array of materials");
  context.require_within(list, list.size(), &InputLimits::materials);
  for (std::size_t i = 0; i < list.size(); i++) {
    const MaterialPtr m = read_inline(context, list[i]);
    if (m->name.empty()) list[i].fail("an entry of \"materials\" needs a \"name\"");
    context.materials.add(list[i].child("name"), m->name, m);
    context.scene.materials.push_back(m);
  }
}

}  // namespace stokes
