// Mitsuba's spectra and textures to ours.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "import/mitsuba_import.h"

namespace stokes {
namespace {

double linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

}  // namespace

pugi::xml_node MitsubaImport::follow(const Node& reference) const {
  if (std::strcmp(reference.name(), "ref") != 0) return reference;
  const std::string id = xml_.attribute(reference, "id");
  const Node target = xml_.by_id(id);
  if (!target) xml_.fail(reference, "nothing has the id \"" + id + "\"");
  return target;
}

// The name, as the scene will have it, of a file that must be there.
std::string MitsubaImport::existing_file(const Node& node, const std::string& path) const {
  const std::string file = xml_.file_named(node, path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) xml_.fail(node, "there is no file \"" + path + "\"");
  return relative_file(target_, "", file);
}

ImportJson MitsubaImport::texture_of(const Node& texture) {
  xml_.use(texture);
  const std::string type = texture.attribute("type").value();
  if (type == "bitmap") {
    const Node filename = xml_.child(texture, "filename");
    if (!filename) xml_.fail(texture, "the bitmap names no file");
    ImportJson j = {{"type", "image"}, {"filename", existing_file(filename, xml_.attribute(filename, "value"))}};
    if (xml_.number(texture, "raw", 0) != 0) j["raw"] = true;
    if (xml_.text(texture, "filter_type", "bilinear") == "nearest") j["filter"] = "nearest";
    const std::string wrap = xml_.text(texture, "wrap_mode", "repeat");
    if (wrap == "clamp") j["wrap"] = "clamp";
    if (wrap != "clamp" && wrap != "repeat") note(texture, "the wrap mode \"" + wrap + "\" has no counterpart here: the image is repeated");
    return j;
  }
  if (type == "checkerboard") {
    note(texture, "a checkerboard by uv has no counterpart here: color0 is taken everywhere");
    return spectrum_child(texture, "color0", Role::Reflectance, 0.4);
  }
  note(texture, "a texture of type \"" + type + "\" has no counterpart here: grey 0.5 is taken");
  return 0.5;
}

ImportJson MitsubaImport::rgb_of(const Node& node) {
  const std::string value = xml_.attribute(node, "value");
  if (value.starts_with("#")) {
    unsigned packed = 0;
    const auto [end, error] = std::from_chars(value.data() + 1, value.data() + value.size(), packed, 16);
    if (value.size() != 7 || error != std::errc() || end != value.data() + 7) xml_.fail(node, "expected #rrggbb, not \"" + value + "\"");
    return ImportJson::array({linear((packed >> 16) / 255.0), linear((packed >> 8 & 255) / 255.0), linear((packed & 255) / 255.0)});
  }
  const std::vector<double> v = xml_.numbers(node, value);
  if (v.size() == 1) return ImportJson::array({v[0], v[0], v[0]});
  if (v.size() != 3) xml_.fail(node, "expected three numbers, not \"" + value + "\"");
  return ImportJson::array({v[0], v[1], v[2]});
}

// Mitsuba's curves are 0 outside their samples; an index must not be.
ImportJson MitsubaImport::sampled_of(const Node& node, const std::vector<double>& wavelengths, const std::vector<double>& values,
                                     Role role) {
  if (wavelengths.size() != values.size() || wavelengths.size() < 2)
    xml_.fail(node, "a spectrum needs two samples at least, and a value for each wavelength");
  if (!std::is_sorted(wavelengths.begin(), wavelengths.end())) xml_.fail(node, "the wavelengths of a spectrum do not increase");
  ImportJson j = {{"type", "sampled"}, {"wavelengths", wavelengths}, {"values", values}};
  if (role != Role::Index)
    j["extrapolate"] = "zero";
  else if (wavelengths.front() > kFilmBegin || wavelengths.back() < kFilmEnd)
    note(node, kHeld);
  return j;
}

// "regular" and "irregular": lists of numbers.
ImportJson MitsubaImport::listed_spectrum_of(const Node& node, Role role) {
  const auto list = [&](const char* name) {
    const Node c = xml_.child(node, name);
    return c ? xml_.numbers(c, xml_.attribute(c, "value")) : std::vector<double>();
  };
  const std::vector<double> values = list("values");
  std::vector<double> wavelengths = list("wavelengths");
  if (std::strcmp(node.attribute("type").value(), "regular") == 0) {
    const double low = xml_.number(node, "wavelength_min", 360), high = xml_.number(node, "wavelength_max", 830);
    for (std::size_t i = 0; i < values.size(); i++)
      wavelengths.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(values.size() - 1));
  }
  return sampled_of(node, wavelengths, values, role);
}

ImportJson MitsubaImport::spectrum_of(const Node& given, Role role) {
  const Node node = follow(given);
  xml_.use(node);
  const std::string tag = node.name(), type = node.attribute("type").value(), value = xml_.attribute(node, "value");
  if (tag == "texture") return texture_of(node);
  if (tag == "rgb") return rgb_of(node);
  if (tag == "spectrum" && (type == "d65" || type == "uniform"))
    return scaled(type == "d65" ? ImportJson(1.0) : ImportJson{{"type", "constant"}, {"value", xml_.number(node, "value", 1)}},
                  xml_.number(node, "scale", 1));
  if (tag == "spectrum" && (type == "regular" || type == "irregular")) return listed_spectrum_of(node, role);
  if (tag == "spectrum" && type == "blackbody") {
    note(node, "a blackbody is normalised to a luminance of 1 here, and in W m^-2 sr^-1 nm^-1 there: set its \"scale\"");
    return {{"type", "blackbody"}, {"temperature", xml_.number(node, "temperature", 5000)}, {"scale", xml_.number(node, "scale", 1)}};
  }
  if (tag == "spectrum" && !xml_.attribute(node, "filename").empty()) {
    ImportJson j = {{"type", "file"}, {"filename", existing_file(node, xml_.attribute(node, "filename"))}};
    if (role != Role::Index) j["extrapolate"] = "zero";
    return j;
  }
  if (tag == "spectrum" && value.find(':') != std::string::npos) {
    std::string flat = value;
    std::replace(flat.begin(), flat.end(), ':', ' ');
    const std::vector<double> v = xml_.numbers(node, flat);
    std::vector<double> wavelengths, values;
    for (std::size_t i = 0; i < v.size(); i++) (i % 2 == 0 ? wavelengths : values).push_back(v[i]);
    return sampled_of(node, wavelengths, values, role);
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

}  // namespace stokes
