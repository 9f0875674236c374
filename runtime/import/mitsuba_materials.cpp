// Mitsuba's BSDFs and media to ours.
#include <cstring>

#include "import/mitsuba_import.h"
#include "scene/csv.h"

namespace stokes {
namespace {

// Mitsuba's names of transparent media.
std::optional<double> named_index(const std::string& name) {
  static const std::map<std::string, double> table = {
      {"vacuum", 1.0},         {"helium", 1.000036},    {"hydrogen", 1.000132},      {"air", 1.000277},     {"carbon dioxide", 1.00045},
      {"water", 1.3330},       {"acetone", 1.36},       {"ethanol", 1.361},          {"carbon tetrachloride", 1.461}, {"glycerol", 1.4729},
      {"benzene", 1.501},      {"silicone oil", 1.52045}, {"bromine", 1.661},        {"water ice", 1.31},   {"fused quartz", 1.458},
      {"pyrex", 1.470},        {"acrylic glass", 1.49}, {"polypropylene", 1.49},     {"bk7", 1.5046},       {"sodium chloride", 1.544},
      {"amber", 1.55},         {"pet", 1.5750},         {"diamond", 2.419}};
  const auto it = table.find(name);
  return it == table.end() ? std::nullopt : std::optional(it->second);
}

}  // namespace

// A factor that our materials do not have: only 1 can be kept.
void MitsubaImport::expect_one(const Node& bsdf, const char* name) {
  const Node c = xml_.child(bsdf, name);
  if (!c) return;
  const ImportJson value = spectrum_of(c, Role::Reflectance);
  if (value != ImportJson(1.0) && value != ImportJson::array({1.0, 1.0, 1.0})) note(c, std::string(name) + " has no counterpart here and was left out");
}

double MitsubaImport::index_of(const Node& bsdf, const char* name, const char* fallback) {
  const Node c = xml_.child(bsdf, name);
  const std::string value = c ? xml_.attribute(c, "value") : fallback;
  if (const auto index = named_index(value)) return *index;
  const auto number = parse_number(value);
  if (!number || !(*number > 0)) xml_.fail(c, "\"" + value + "\" is neither an index of refraction nor a name that Mitsuba has for one");
  return *number;
}

double MitsubaImport::alpha_of(const Node& bsdf) {
  const Node distribution = xml_.child(bsdf, "distribution");
  if ((distribution ? xml_.attribute(distribution, "value") : "beckmann") != "ggx")
    note(distribution ? distribution : bsdf, "a Beckmann distribution becomes GGX of the same alpha");
  xml_.child(bsdf, "sample_visible");
  if (const Node u = xml_.child(bsdf, "alpha_u")) note(u, "anisotropic roughness becomes isotropic, of alpha_u");
  return xml_.number(bsdf, "alpha", xml_.number(bsdf, "alpha_u", 0.1));
}

ImportJson MitsubaImport::conductor_of(const Node& bsdf, bool rough) {
  ImportJson j = {{"type", "conductor"}};
  const Node named = xml_.child(bsdf, "material");
  const std::string name = named ? xml_.attribute(named, "value") : "";
  const bool own = bsdf.find_child_by_attribute("name", "eta");
  if ((name == "none" || (name.empty() && !own)) && !rough)
    return {{"type", "metal"}, {"albedo", spectrum_child(bsdf, "specular_reflectance", Role::Reflectance, 1.0)}};
  if (own) {
    j["eta"] = spectrum_child(bsdf, "eta", Role::Index, 0.2);
    j["k"] = spectrum_child(bsdf, "k", Role::Index, 3.9);
  } else {
    ImportJson metal = metal_of(name);
    if (metal.is_null()) {
      note(named ? named : bsdf, "there is no data for this metal here: it becomes silver");
      metal = metal_of("Ag");
    }
    j.update(metal);
  }
  if (rough) j["alpha"] = alpha_of(bsdf);
  expect_one(bsdf, "specular_reflectance");
  return j;
}

ImportJson MitsubaImport::dielectric_of(const Node& bsdf, bool rough) {
  const double inside = index_of(bsdf, "int_ior", "bk7"), outside = index_of(bsdf, "ext_ior", "air");
  ImportJson j = {{"type", "dielectric"}, {"ior", inside / outside}};
  if (rough) j["alpha"] = alpha_of(bsdf);
  expect_one(bsdf, "specular_reflectance");
  expect_one(bsdf, "specular_transmittance");
  return j;
}

// A BSDF within another, by a reference perhaps, which may lead in a circle.
ImportJson MitsubaImport::inner_material(const Node& bsdf) {
  if (material_depth_ >= kDeepestImport) xml_.fail(bsdf, "BSDFs lie in each other more than " + std::to_string(kDeepestImport) + " deep, or in a circle");
  material_depth_++;
  ImportJson material = material_of(bsdf);
  material_depth_--;
  return material;
}

ImportJson MitsubaImport::material_of(const Node& given) {
  if (std::strcmp(given.name(), "ref") == 0) {
    xml_.use(given);
    const std::string id = xml_.attribute(given, "id");
    if (materials_.count(id)) return id;
  }
  if (++material_count_ > kMostMaterials) xml_.fail(given, "more than " + std::to_string(kMostMaterials) + " BSDFs, counted as often as they are referred to");
  const Node bsdf = follow(given);
  xml_.use(bsdf);
  const std::string type = bsdf.attribute("type").value();
  if (type == "diffuse") return {{"type", "lambertian"}, {"albedo", spectrum_child(bsdf, "reflectance", Role::Reflectance, 0.5)}};
  if (type == "conductor" || type == "roughconductor") return conductor_of(bsdf, type != "conductor");
  if (type == "dielectric" || type == "roughdielectric") return dielectric_of(bsdf, type != "dielectric");
  if (type == "null") return {{"type", "interface"}};
  std::vector<Node> inner;
  for (const Node& c : bsdf.children())
    if (std::strcmp(c.name(), "bsdf") == 0 || (std::strcmp(c.name(), "ref") == 0 && std::strcmp(follow(c).name(), "bsdf") == 0)) inner.push_back(c);
  // Opaque materials reflect on both sides here anyway.
  if (type == "twosided" && inner.size() == 1) return inner_material(inner[0]);
  if (type == "blendbsdf" && inner.size() == 2)
    return {{"type", "blend"}, {"a", inner_material(inner[0])}, {"b", inner_material(inner[1])}, {"amount", spectrum_child(bsdf, "weight", Role::Reflectance, 0.5)}};
  if ((type == "bumpmap" || type == "normalmap" || type == "mask") && inner.size() == 1) {
    note(bsdf, "a BSDF of type \"" + type + "\" has no counterpart here: what it lies on is taken");
    return inner_material(inner[0]);
  }
  return other_material_of(bsdf, type);
}

// What is left of a material without a counterpart: its diffuse colour.
ImportJson MitsubaImport::other_material_of(const Node& bsdf, const std::string& type) {
  const char* colour = type == "principled" || type == "principledthin" ? "base_color" : "diffuse_reflectance";
  const bool has_colour = bsdf.find_child_by_attribute("name", colour);
  note(bsdf, "a BSDF of type \"" + type + "\" has no counterpart here: a matte " + (has_colour ? std::string("one of its ") + colour : "grey") + " is taken");
  return {{"type", "lambertian"}, {"albedo", spectrum_child(bsdf, colour, Role::Reflectance, 0.5)}};
}

ImportJson MitsubaImport::shape_material(const Node& shape, bool emits) {
  for (const Node& c : shape.children()) {
    const bool reference = std::strcmp(c.name(), "ref") == 0 && std::strcmp(follow(c).name(), "bsdf") == 0;
    if (std::strcmp(c.name(), "bsdf") == 0 || reference) return material_of(c);
  }
  // Mitsuba's default: lamps are black.
  return {{"type", "lambertian"}, {"albedo", emits ? 0.0 : 0.5}};
}

ImportJson MitsubaImport::medium_of(const Node& medium) {
  xml_.use(medium);
  if (std::strcmp(medium.attribute("type").value(), "homogeneous") != 0) {
    note(medium, std::string("a medium of type \"") + medium.attribute("type").value() + "\" has no counterpart here: vacuum is taken");
    return nullptr;
  }
  const double scale = xml_.number(medium, "scale", 1);
  ImportJson j = {{"type", "homogeneous"},
                  {"sigma_t", scaled(spectrum_child(medium, "sigma_t", Role::Coefficient, 1.0), scale)},
                  {"albedo", spectrum_child(medium, "albedo", Role::Reflectance, 0.75)}};
  for (const Node& phase : medium.children("phase")) {
    const std::string type = phase.attribute("type").value();
    if (type != "hg" && type != "isotropic") continue;  // noted as left out
    xml_.use(phase);
    if (type == "hg") j["g"] = xml_.number(phase, "g", 0.8);
  }
  return j;
}

ImportJson MitsubaImport::shape_medium(const Node& shape, const char* side) {
  const Node c = xml_.child(shape, side);
  if (!c) return nullptr;
  if (std::strcmp(c.name(), "ref") == 0 && media_.count(xml_.attribute(c, "id"))) return xml_.attribute(c, "id");
  return medium_of(follow(c));
}

}  // namespace stokes
