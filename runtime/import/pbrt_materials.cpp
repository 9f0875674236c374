// pbrt's spectra, textures, materials and media to ours.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "import/pbrt_import.h"
#include "input/limits.h"
#include "input/read_file.h"
#include "scene/csv.h"
#include "spectral/tabulate.h"

namespace stokes {
namespace {

// The luminance of an emission that is 0 outside its samples.
double luminance_of(const Curve& curve) {
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  std::tie(s.wavelengths, s.values) = curve;
  return emission_xyz(tabulate(s, SpectrumRole::Emission)).y;
}

// Numbers in pairs, with comments; empty where the file is none such.
Curve parse_spd(const std::string& text) {
  std::istringstream file(text);
  Curve curve;
  std::vector<double> all;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;) {
      const auto value = parse_number(word);
      if (!value || !std::isfinite(*value)) return {};
      all.push_back(*value);
    }
  }
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) curve.first.push_back(all[i]), curve.second.push_back(all[i + 1]);
  for (std::size_t i = 1; i < curve.first.size(); i++)
    if (curve.first[i] <= curve.first[i - 1]) return {};
  return curve;
}

// pbrt's metal of a given reflectance at normal incidence: an index of 1, and k = 2 sqrt(r / (1 - r)) at every wavelength.
ImportJson metal_by_reflectance(const Spectrum& reflectance) {
  ImportJson k = {{"type", "sampled"}, {"wavelengths", ImportJson::array()}, {"values", ImportJson::array()}};
  for (double nm = kLambdaMin; nm <= kLambdaMax; nm += 5) {
    const double r = std::min(std::max(evaluate(reflectance, SpectrumRole::Reflectance, nm), 0.0), 0.9999);
    k["wavelengths"].push_back(nm);
    k["values"].push_back(std::round(2e4 * std::sqrt(r / (1 - r))) / 1e4);
  }
  return {{"type", "conductor"}, {"eta", 1.0}, {"k", k}};
}

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
    const auto it = textures_.find("spectrum " + p->words[0]);
    if (it == textures_.end()) throw ImportError(d.file, p->line, "no texture is called \"" + p->words[0] + "\"");
    return it->second;
  }
  if (p->type == "spectrum" && v.size() >= 2 && v.size() % 2 == 0) {
    ImportJson j = {{"type", "sampled"}, {"wavelengths", ImportJson::array()}, {"values", ImportJson::array()}};
    Curve curve;
    for (std::size_t i = 0; i < v.size(); i += 2) curve.first.push_back(v[i]), curve.second.push_back(v[i + 1]);
    for (std::size_t i = 1; i < curve.first.size(); i++)
      if (curve.first[i] <= curve.first[i - 1]) throw ImportError(d.file, p->line, "the wavelengths of \"" + p->name + "\" do not increase");
    j["wavelengths"] = curve.first;
    j["values"] = curve.second;
    return as_curve(std::move(j), curve, d, *p, role);
  }
  if (p->type == "spectrum" && p->words.size() == 1) return named_spectrum_of(d, *p, role, fallback);
  out_.note(d.file, p->line, "\"" + p->type + " " + p->name + "\" is not understood: a default is taken");
  return fallback;
}

// pbrt's curves are 0 outside their samples; an index must not be. Lamps shine with a luminance of 1, whatever their curve's height.
ImportJson PbrtImport::as_curve(ImportJson j, const Curve& curve, const PbrtDirective& d, const PbrtParameter& p, Role role) {
  if (role != Role::Index) j["extrapolate"] = "zero";
  else if (curve.first.front() > kFilmBegin || curve.first.back() < kFilmEnd) out_.note(d.file, p.line, kHeld);
  if (role != Role::Emission) return j;
  const double luminance = luminance_of(curve);
  if (luminance > 0) return scaled(std::move(j), 1 / luminance);
  out_.note(d.file, p.line, "\"" + p.name + "\" cannot be seen, so pbrt's luminance of 1 is not to be had: its numbers are taken as they are");
  return j;
}

ImportJson PbrtImport::named_spectrum_of(const PbrtDirective& d, const PbrtParameter& p, Role role, const ImportJson& fallback) {
  const std::string& word = p.words[0];
  if (word == "stdillum-D65" && role == Role::Emission) return 1.0;
  if ((word == "stdillum-A" || word == "stdillum-F11") && role == Role::Emission) return {{"type", "illuminant"}, {"name", word.substr(9)}};
  if (const auto index = glass(word)) {
    out_.note(d.file, p.line, "the dispersion of " + word + " was left out: its index at 588 nm is taken");
    return *index;
  }
  Curve curve;
  std::string reason = "it holds no samples";
  try {
    curve = parse_spd(read_regular_file(path_beside(target_, folder_, word), InputLimits{}.table_bytes));
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {
    reason = error.what();
  }
  if (!curve.first.empty()) return as_curve({{"type", "file"}, {"filename", relative_file(target_, folder_, word)}}, curve, d, p, role);
  out_.note(d.file, p.line, "\"spectrum " + p.name + "\": nothing is known of \"" + word + "\", and as a file " + reason + ": a default is taken");
  return fallback;
}

// A number, where pbrt also takes a texture.
double PbrtImport::plain_number(const PbrtDirective& d, const char* name, double fallback) {
  const PbrtParameter* p = d.find(name);
  if (!p || p->type != "texture") return d.number(name, fallback);
  const auto it = p->words.size() == 1 ? textures_.find("float " + p->words[0]) : textures_.end();
  if (it == textures_.end()) throw ImportError(d.file, p->line, "no texture of floats is called \"" + (p->words.empty() ? "" : p->words[0]) + "\"");
  if (it->second.is_number()) return it->second.get<double>();
  out_.note(d.file, p->line, std::string("a texture cannot be the ") + name + " here: " + std::to_string(fallback) + " is taken");
  return fallback;
}

ImportJson PbrtImport::texture_of(const PbrtDirective& d) {
  const std::string type = d.words.size() > 2 ? d.words[2] : "";
  if (type == "constant") return spectrum_of(d, "value", Role::Reflectance, 1.0);
  if (type == "imagemap") {
    ImportJson j = {{"type", "image"}, {"filename", relative_file(target_, folder_, d.text("filename", ""))}};
    const std::string encoding = d.text("encoding", "sRGB"), wrap = d.text("wrap", "repeat");
    if (encoding == "linear") j["raw"] = true;
    if (encoding != "linear" && encoding != "sRGB") note(d, "the encoding \"" + encoding + "\" has no counterpart here: sRGB is taken");
    if (wrap == "clamp") j["wrap"] = "clamp";
    if (wrap != "clamp" && wrap != "repeat") note(d, "the wrap mode \"" + wrap + "\" has no counterpart here: the image is repeated");
    if (d.text("filter", "bilinear") == "point") j["filter"] = "nearest";
    if (d.find("scale")) j["scale"] = d.number("scale", 1);
    if (d.text("invert", "false") == "true") note(d, "\"invert\" has no counterpart here and was left out");
    return j;
  }
  if (type == "scale") return scaled(spectrum_of(d, "tex", Role::Reflectance, 1.0), plain_number(d, "scale", 1));
  note(d, "a texture of type \"" + type + "\" has no counterpart here: grey 0.5 is taken");
  for (const PbrtParameter& parameter : d.parameters) parameter.used = true;
  return 0.5;
}

double PbrtImport::alpha_of(const PbrtDirective& d) {
  const double roughness = plain_number(d, "roughness", 0), u = plain_number(d, "uroughness", roughness), v = plain_number(d, "vroughness", roughness);
  if (u != v) note(d, "anisotropic roughness becomes isotropic, of uroughness");
  // pbrt's mapping from the artists' roughness.
  const double alpha = d.text("remaproughness", "true") == "true" ? std::sqrt(u) : u;
  return alpha < 1e-3 ? 0 : alpha;  // what pbrt takes as smooth
}

ImportJson PbrtImport::conductor_of(const PbrtDirective& d) {
  const double alpha = alpha_of(d);
  ImportJson j = {{"type", "conductor"}};
  if (const PbrtParameter* p = d.find("reflectance")) {
    const ImportJson given = spectrum_of(d, "reflectance", Role::Reflectance, 0.5);
    Spectrum r;
    r.kind = given.is_array() ? SpectrumKind::Rgb : given.is_number() ? SpectrumKind::Number : SpectrumKind::Sampled;
    if (given.is_array()) r.rgb = {given[0].get<double>(), given[1].get<double>(), given[2].get<double>()};
    if (given.is_number()) r.value = given.get<double>();
    if (r.kind == SpectrumKind::Sampled && given["type"] != "sampled") {
      out_.note(d.file, p->line, "a conductor's reflectance by a texture or a file is taken as a mirror of that albedo");
      return {{"type", "metal"}, {"albedo", given}, {"roughness", alpha}};
    }
    if (r.kind == SpectrumKind::Sampled) {
      r.wavelengths = given["wavelengths"].get<std::vector<double>>();
      r.values = given["values"].get<std::vector<double>>();
      r.extrapolate = Extrapolate::Zero;
    }
    j = metal_by_reflectance(r);
  } else {
    const PbrtParameter *eta = d.find("eta"), *k = d.find("k");
    const auto metal_named = [](const PbrtParameter* given, const std::string& ending) -> std::string {
      if (!given) return "Cu";
      const std::string word = given->words.size() == 1 ? given->words[0] : "";
      return word.starts_with("metal-") && word.ends_with(ending) ? word.substr(6, word.size() - 6 - ending.size()) : "";
    };
    const auto optical = [&](const PbrtParameter* given, const char* name) -> ImportJson {
      const std::string metal = metal_named(given, std::string("-") + name);
      const ImportJson copper = metal_of("Cu")[name];
      if (metal.empty()) return spectrum_of(d, name, Role::Index, copper);
      if (ImportJson known = metal_of(metal); !known.is_null()) return known[name];
      out_.note(d.file, given->line, "there is no data for " + given->words[0] + " here: copper's is taken");
      return copper;
    };
    j["eta"] = optical(eta, "eta");
    j["k"] = optical(k, "k");
  }
  if (alpha > 0) j["alpha"] = alpha;
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
    if (pair && pair->words.size() == 2 && made_materials_.count(pair->words[0]) && made_materials_.count(pair->words[1]))
      return {{"type", "blend"}, {"a", pair->words[0]}, {"b", pair->words[1]}, {"amount", plain_number(d, "amount", 0.5)}};
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
