// Mitsuba's spectra, textures, BSDFs and media to ours.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "import/mitsuba_import.h"

namespace stokes {
namespace {

double linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

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

pugi::xml_node MitsubaImport::follow(const Node& reference) const {
  if (std::strcmp(reference.name(), "ref") != 0) return reference;
  const std::string id = xml_.attribute(reference, "id");
  const auto it = by_id_.find(id);
  if (it == by_id_.end()) xml_.fail(reference, "nothing has the id \"" + id + "\"");
  return it->second;
}

ImportJson MitsubaImport::texture_of(const Node& texture) {
  xml_.use(texture);
  const std::string type = texture.attribute("type").value();
  if (type == "bitmap") {
    ImportJson j = {{"type", "image"}, {"filename", relative_file(target_, folder_, xml_.text(texture, "filename", ""))}};
    if (xml_.number(texture, "raw", 0) != 0) j["raw"] = true;
    if (xml_.text(texture, "filter_type", "bilinear") == "nearest") j["filter"] = "nearest";
    if (xml_.text(texture, "wrap_mode", "repeat") == "clamp") j["wrap"] = "clamp";
    return j;
  }
  if (type == "checkerboard") {
    note(texture, "a checkerboard by uv has no counterpart here: color0 is taken everywhere");
    return spectrum_child(texture, "color0", Role::Reflectance, 0.4);
  }
  note(texture, "a texture of type \"" + type + "\" has no counterpart here: grey 0.5 is taken");
  return 0.5;
}

ImportJson MitsubaImport::spectrum_of(const Node& given, Role role) {
  const Node node = follow(given);
  xml_.use(node);
  const std::string tag = node.name(), type = node.attribute("type").value(), value = xml_.attribute(node, "value");
  if (tag == "texture") return texture_of(node);
  if (tag == "rgb" && value.starts_with("#") && value.size() == 7) {
    ImportJson rgb = ImportJson::array();
    for (std::size_t i = 1; i < 7; i += 2) rgb.push_back(linear(std::stoi(value.substr(i, 2), nullptr, 16) / 255.0));
    return rgb;
  }
  if (tag == "rgb") {
    const std::vector<double> v = xml_.numbers(node, value);
    if (v.size() == 1) return ImportJson::array({v[0], v[0], v[0]});
    if (v.size() != 3) xml_.fail(node, "expected three numbers, not \"" + value + "\"");
    return ImportJson::array({v[0], v[1], v[2]});
  }
  if (tag == "spectrum" && (type == "d65" || type == "uniform"))
    return scaled(type == "d65" ? ImportJson(1.0) : ImportJson{{"type", "constant"}, {"value", xml_.number(node, "value", 1)}}, xml_.number(node, "scale", 1));
  if (tag == "spectrum" && type == "blackbody") {
    note(node, "a blackbody is normalised to a luminance of 1 here, and in W m^-2 sr^-1 nm^-1 there: set its \"scale\"");
    return {{"type", "blackbody"}, {"temperature", xml_.number(node, "temperature", 5000)}, {"scale", xml_.number(node, "scale", 1)}};
  }
  if (tag == "spectrum" && !xml_.attribute(node, "filename").empty())
    return {{"type", "file"}, {"filename", relative_file(target_, folder_, xml_.attribute(node, "filename"))}};
  if (tag == "spectrum" && value.find(':') != std::string::npos) {
    std::string flat = value;
    std::replace(flat.begin(), flat.end(), ':', ' ');
    const std::vector<double> v = xml_.numbers(node, flat);
    ImportJson j = {{"type", "sampled"}, {"wavelengths", ImportJson::array()}, {"values", ImportJson::array()}};
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) j["wavelengths"].push_back(v[i]), j["values"].push_back(v[i + 1]);
    // Mitsuba's curves are 0 outside their samples; an index must not be.
    if (role != Role::Index) j["extrapolate"] = "zero";
    else if (v.empty() || v.front() > kFilmBegin || v[v.size() - 2] < kFilmEnd) note(node, kHeld);
    return j;
  }
  if (tag == "float" || tag == "integer" || (tag == "spectrum" && type.empty())) {
    const std::vector<double> v = xml_.numbers(node, value);
    // A <spectrum> of one number is the same at every wavelength, also as an emission; a <float> is D65-shaped there, as our numbers are.
    if (v.size() == 1 && tag == "spectrum" && role == Role::Emission) return {{"type", "constant"}, {"value", v[0]}};
    if (v.size() == 1) return v[0];
  }
  note(node, "this spectrum is not understood: " + std::string(role == Role::Emission ? "1" : "0.5") + " is taken");
  return role == Role::Emission ? 1.0 : 0.5;
}

ImportJson MitsubaImport::spectrum_child(const Node& node, const char* name, Role role, const ImportJson& fallback) {
  const Node c = xml_.child(node, name);
  if (!c) return fallback;
  ImportJson spectrum = spectrum_of(c, role);
  if (role == Role::Reflectance && spectrum.is_array())
    for (ImportJson& component : spectrum)
      if (component.get<double>() > 1) {
        note(c, "a reflectance above 1 is cut to 1");
        component = 1.0;
      }
  return spectrum;
}

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
  const std::vector<double> number = xml_.numbers(c, value);
  if (number.size() != 1) xml_.fail(c, "no index of refraction");
  return number[0];
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

ImportJson MitsubaImport::material_of(const Node& given) {
  if (std::strcmp(given.name(), "ref") == 0) {
    xml_.use(given);
    const std::string id = xml_.attribute(given, "id");
    if (materials_.count(id)) return id;
  }
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
  if (type == "twosided" && inner.size() == 1) return material_of(inner[0]);
  if (type == "blendbsdf" && inner.size() == 2)
    return {{"type", "blend"}, {"a", material_of(inner[0])}, {"b", material_of(inner[1])}, {"amount", spectrum_child(bsdf, "weight", Role::Reflectance, 0.5)}};
  if ((type == "bumpmap" || type == "normalmap" || type == "mask") && inner.size() == 1) {
    note(bsdf, "a BSDF of type \"" + type + "\" has no counterpart here: what it lies on is taken");
    return material_of(inner[0]);
  }
  note(bsdf, "a BSDF of type \"" + type + "\" has no counterpart here: a matte grey is taken");
  return {{"type", "lambertian"}, {"albedo", 0.5}};
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
