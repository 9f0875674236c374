// pbrt's spectra, textures, materials and media to ours.
#include <cmath>
#include <filesystem>

#include "import/pbrt_import.h"

namespace stokes {
namespace {

std::optional<double> glass(const std::string& name) {
  static const std::map<std::string, double> table = {{"glass-BK7", 1.5168}, {"glass-BAF10", 1.6700}, {"glass-FK51A", 1.4866}, {"glass-LASF9", 1.8503},
                                                      {"glass-F5", 1.6034},  {"glass-F10", 1.6228},   {"glass-F11", 1.6206}};
  const auto it = table.find(name);
  return it == table.end() ? std::nullopt : std::optional(it->second);
}

}  // namespace

ImportJson PbrtImport::spectrum_of(const PbrtDirective& d, const char* name, Role role, const ImportJson& fallback) {
  const PbrtParameter* p = d.find(name);
  if (!p) return fallback;
  const std::vector<double>& v = p->numbers;
  if (p->type == "rgb" && v.size() == 3) return ImportJson::array({v[0], v[1], v[2]});
  if (p->type == "float" && v.size() == 1) return v[0];
  if (p->type == "blackbody" && v.size() == 1) return {{"type", "blackbody"}, {"temperature", v[0]}};
  if (p->type == "texture" && p->words.size() == 1) {
    const auto it = textures_.find(p->words[0]);
    if (it == textures_.end()) throw ImportError(d.file, p->line, "no texture is called \"" + p->words[0] + "\"");
    return it->second;
  }
  if (p->type == "spectrum" && v.size() >= 2 && v.size() % 2 == 0) {
    ImportJson j = {{"type", "sampled"}, {"wavelengths", ImportJson::array()}, {"values", ImportJson::array()}};
    for (std::size_t i = 0; i < v.size(); i += 2) j["wavelengths"].push_back(v[i]), j["values"].push_back(v[i + 1]);
    // pbrt's curves are 0 outside their samples; an index must not be.
    if (role != Role::Index) j["extrapolate"] = "zero";
    return j;
  }
  if (p->type == "spectrum" && p->words.size() == 1) {
    const std::string& word = p->words[0];
    if (word == "stdillum-D65") return 1.0;
    if (word == "stdillum-A" || word == "stdillum-F11") return {{"type", "illuminant"}, {"name", word.substr(9)}};
    if (const auto index = glass(word)) {
      out_.note(d.file, p->line, "the dispersion of " + word + " was left out: its index at 588 nm is taken");
      return *index;
    }
    if (word.ends_with(".spd")) return {{"type", "file"}, {"filename", relative_file(target_, std::filesystem::path(d.file).parent_path().string(), word)}};
  }
  out_.note(d.file, p->line, "\"" + p->type + " " + p->name + "\" is not understood: a default is taken");
  return fallback;
}

ImportJson PbrtImport::texture_of(const PbrtDirective& d) {
  const std::string type = d.words.size() > 2 ? d.words[2] : "";
  if (type == "constant") return spectrum_of(d, "value", Role::Reflectance, 1.0);
  if (type == "imagemap") {
    ImportJson j = {{"type", "image"}, {"filename", relative_file(target_, std::filesystem::path(d.file).parent_path().string(), d.text("filename", ""))}};
    if (d.text("encoding", "sRGB") == "linear") j["raw"] = true;
    if (d.text("wrap", "repeat") == "clamp") j["wrap"] = "clamp";
    if (d.text("filter", "bilinear") == "point") j["filter"] = "nearest";
    if (d.find("scale")) j["scale"] = d.number("scale", 1);
    return j;
  }
  if (type == "scale") return scaled(spectrum_of(d, "tex", Role::Reflectance, 1.0), d.number("scale", 1));
  note(d, "a texture of type \"" + type + "\" has no counterpart here: grey 0.5 is taken");
  return 0.5;
}

double PbrtImport::alpha_of(const PbrtDirective& d) {
  if (d.find("uroughness") || d.find("vroughness")) note(d, "anisotropic roughness becomes isotropic, of uroughness");
  const double roughness = d.number("uroughness", d.number("roughness", 0));
  // pbrt's mapping from the artists' roughness.
  return d.text("remaproughness", "true") == "true" ? std::sqrt(roughness) : roughness;
}

ImportJson PbrtImport::conductor_of(const PbrtDirective& d) {
  ImportJson j = {{"type", "conductor"}};
  const PbrtParameter* eta = d.find("eta");
  d.find("k");
  if (const PbrtParameter* reflectance = d.find("reflectance")) {
    (void)reflectance;
    j["eta"] = 1.0;
    note(d, "a conductor by its reflectance is taken as a mirror of that albedo");
    return {{"type", "metal"}, {"albedo", spectrum_of(d, "reflectance", Role::Reflectance, 0.9)}, {"roughness", alpha_of(d)}};
  }
  const std::string name = eta && eta->words.size() == 1 ? eta->words[0] : eta ? "" : "metal-Cu-eta";
  if (name.empty()) {
    j["eta"] = spectrum_of(d, "eta", Role::Index, 0.2);
    j["k"] = spectrum_of(d, "k", Role::Index, 3.9);
  } else {
    if (!name.starts_with("metal-Au") && !name.starts_with("metal-Ag")) note(d, "there is no data for " + name + " here: it becomes silver");
    j.update(metal_of(name.starts_with("metal-Au")));
  }
  j["alpha"] = alpha_of(d);
  return j;
}

ImportJson PbrtImport::material_of(const PbrtDirective& d, const std::string& type) {
  if (type == "diffuse") return {{"type", "lambertian"}, {"albedo", spectrum_of(d, "reflectance", Role::Reflectance, 0.5)}};
  if (type == "conductor") return conductor_of(d);
  if (type == "dielectric") {
    ImportJson j = {{"type", "dielectric"}, {"ior", spectrum_of(d, "eta", Role::Index, 1.5)}};
    if (const double alpha = alpha_of(d); alpha > 0) j["alpha"] = alpha;
    return j;
  }
  if (type == "interface" || type.empty()) return {{"type", "interface"}};
  if (type == "mix") {
    const PbrtParameter* pair = d.find("materials");
    if (pair && pair->words.size() == 2 && materials_.count(pair->words[0]) && materials_.count(pair->words[1]))
      return {{"type", "blend"}, {"a", pair->words[0]}, {"b", pair->words[1]}, {"amount", d.number("amount", 0.5)}};
  }
  note(d, "a material of type \"" + type + "\" has no counterpart here: a matte one is taken");
  return {{"type", "lambertian"}, {"albedo", spectrum_of(d, "reflectance", Role::Reflectance, 0.5)}};
}

ImportJson PbrtImport::medium_of(const PbrtDirective& d) {
  const double scale = d.number("scale", 1);
  ImportJson j = {{"type", "homogeneous"}, {"name", d.words.at(0)}};
  j["sigma_a"] = scaled(spectrum_of(d, "sigma_a", Role::Coefficient, ImportJson::array({0.0011, 0.0024, 0.014})), scale);
  j["sigma_s"] = scaled(spectrum_of(d, "sigma_s", Role::Coefficient, ImportJson::array({2.55, 3.21, 3.77})), scale);
  if (const double g = d.number("g", 0); g != 0) j["g"] = g;
  return j;
}

}  // namespace stokes
