// The forms of a spectrum, one function each, and the check that their values keep a range.
#include "scene/spectrum_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace stokes {
namespace {

using Form = std::function<void(ReadContext&, const JsonObject&, SpectrumRole, Spectrum&)>;

// Keys that every form takes, beside its own.
std::vector<std::string> with_common_keys(std::vector<std::string> keys) {
  for (const char* key : {"type", "name", "scale", "extrapolate"}) keys.push_back(key);
  return keys;
}

void check_increasing(const JsonNode& node, const std::vector<double>& wavelengths) {
  for (std::size_t i = 1; i < wavelengths.size(); i++)
    if (!(wavelengths[i] > wavelengths[i - 1]))
      node.fail("wavelengths must increase, and " + show(wavelengths[i]) + " follows " + show(wavelengths[i - 1]));
}

void read_sampled(ReadContext& context, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Sampled;
  const JsonNode wavelengths = o.require("wavelengths"), values = o.require("values");
  context.require_within(wavelengths, wavelengths.size(), &InputLimits::curve_samples);
  s.wavelengths = wavelengths.numbers();
  s.values = values.numbers();
  if (s.wavelengths.empty()) wavelengths.fail("a sampled spectrum needs at least one sample");
  if (s.wavelengths.size() != s.values.size())
    values.fail(std::to_string(s.values.size()) + " values for " + std::to_string(s.wavelengths.size()) + " wavelengths");
  for (std::size_t i = 1; i < s.wavelengths.size(); i++)
    if (!(s.wavelengths[i] > s.wavelengths[i - 1]))
      wavelengths[i].fail("wavelengths must increase, and " + show(s.wavelengths[i]) + " follows " + show(s.wavelengths[i - 1]));
}

void read_file(ReadContext& context, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Sampled;
  const JsonNode filename = o.require("filename");
  std::tie(s.wavelengths, s.values) = read_spectrum_file(filename, context.file_path(filename, FileSort::Table), context.limits);
  if (s.wavelengths.empty()) filename.fail("the file holds no samples");
  check_increasing(filename, s.wavelengths);
}

// darts' texture of the same type holds a `color`, a number or [r,g,b].
void read_constant(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  if (const auto color = o.find("color")) {
    if (o.has("value")) o.node().fail("a constant has \"value\" or \"color\", not both");
    if (color->is_number()) {
      s.kind = SpectrumKind::Number;
      s.value = color->number();
    } else {
      s.kind = SpectrumKind::Rgb;
      s.rgb = color->vector();
    }
    return;
  }
  s.kind = SpectrumKind::Constant;
  s.value = o.require("value").number();
}

void read_rgb(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Rgb;
  s.rgb = o.require("value").vector();
  if (const auto uv = o.find("uv")) s.uv = uv->number(kNotNegative);
}

void read_box(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Box;
  const JsonNode range = o.require("range");
  const auto ends = range.numbers(2);
  if (!(ends[0] < ends[1])) range.fail("the range must begin below its end");
  s.a = ends[0];
  s.b = ends[1];
  s.value = o.number("value", 1);
}

void read_gaussian(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Gaussian;
  s.a = o.require("mean").number();
  s.b = o.require("stddev").number(kPositive);
  s.value = o.number("value", 1);
}

void read_blackbody(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Blackbody;
  s.a = o.require("temperature").number({100, 1e7});
}

void read_illuminant(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Illuminant;
  const JsonNode name = o.require("name");
  s.illuminant = name.string();
  const std::vector<std::string> known = {"D65", "A", "E", "F11"};
  if (std::find(known.begin(), known.end(), s.illuminant) == known.end())
    name.fail("no illuminant is called \"" + s.illuminant + "\" (there are D65, A, E and F11)" + did_you_mean(s.illuminant, known));
}

void read_cauchy(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Cauchy;
  s.a = o.require("A").number();
  s.b = o.require("B").number();
}

void read_sellmeier(ReadContext&, const JsonObject& o, SpectrumRole, Spectrum& s) {
  s.kind = SpectrumKind::Sellmeier;
  const auto b = o.require("B").numbers(3), c = o.require("C").numbers(3);
  std::copy(b.begin(), b.end(), s.sellmeier_b.begin());
  std::copy(c.begin(), c.end(), s.sellmeier_c.begin());
  for (int l = 280; l <= 780; l++)
    if (!(plain_value(s, SpectrumRole::Index, l) > 0))
      o.node().fail("the index of refraction is not a positive number at " + std::to_string(l) + " nm");
}

template <SpectrumKind kKind>
void read_combination(ReadContext& context, const JsonObject& o, SpectrumRole role, Spectrum& s) {
  s.kind = kKind;
  const JsonNode of = o.require("of");
  if (!of.is_array()) of.fail_type("an array of spectra");
  if (of.size() == 0) of.fail("there must be at least one spectrum");
  for (std::size_t i = 0; i < of.size(); i++) {
    s.of.push_back(read_spectrum(context, of[i], role, kAnyNumber));
    context.add_part(of[i], &s, s.of.back().get(), &InputLimits::spectra);
  }
}

struct FormEntry {
  std::vector<std::string> keys;
  Form read;
};

const std::map<std::string, FormEntry>& forms() {
  static const std::map<std::string, FormEntry> table = {
      {"sampled", {{"wavelengths", "values"}, read_sampled}},
      {"file", {{"filename"}, read_file}},
      {"constant", {{"value", "color"}, read_constant}},
      {"rgb", {{"value", "uv"}, read_rgb}},
      {"box", {{"range", "value"}, read_box}},
      {"gaussian", {{"mean", "stddev", "value"}, read_gaussian}},
      {"blackbody", {{"temperature"}, read_blackbody}},
      {"illuminant", {{}, read_illuminant}},
      {"cauchy", {{"A", "B"}, read_cauchy}},
      {"sellmeier", {{"B", "C"}, read_sellmeier}},
      {"product", {{"of"}, read_combination<SpectrumKind::Product>}},
      {"sum", {{"of"}, read_combination<SpectrumKind::Sum>}},
  };
  return table;
}

std::shared_ptr<Spectrum> read_object(ReadContext& context, const JsonNode& node, SpectrumRole role) {
  const std::string type = type_of(node, "a spectrum");
  const auto form = forms().find(type);
  if (form == forms().end())
    node.child("type").fail("no spectrum has the type \"" + node.child("type").string() + "\"" + did_you_mean(type, spectrum_types()));
  const JsonObject o(node, "a spectrum of type \"" + type + "\"", with_common_keys(form->second.keys));
  auto s = std::make_shared<Spectrum>();
  s->pointer = node.pointer();
  s->scale = o.number("scale", 1);
  if (type != "illuminant") s->name = o.string("name", "");
  if (const auto extrapolate = o.find("extrapolate")) {
    const std::string how = extrapolate->string();
    if (how != "zero" && how != "hold") extrapolate->fail("expected \"zero\" or \"hold\", not \"" + how + "\"");
    s->extrapolate = how == "zero" ? Extrapolate::Zero : Extrapolate::Hold;
  }
  form->second.read(context, o, role, *s);
  return s;
}

std::shared_ptr<Spectrum> read_inline(ReadContext& context, const JsonNode& node, SpectrumRole role) {
  if (node.is_object()) return read_object(context, node, role);
  auto s = std::make_shared<Spectrum>();
  s->pointer = node.pointer();
  if (node.is_number()) {
    s->kind = SpectrumKind::Number;
    s->value = node.number();
  } else if (node.is_array()) {
    s->kind = SpectrumKind::Rgb;
    s->rgb = node.vector();
  } else {
    node.fail_type("a spectrum (a number, [r, g, b], an object or a name)");
  }
  return s;
}

// Fails at the very value that leaves the range where the form has such a value.
void check_range(const JsonNode& node, const Spectrum& s, SpectrumRole role, const Range& range) {
  if (node.is_number()) {
    node.number(range);
    return;
  }
  if (node.is_array()) {
    for (std::size_t i = 0; i < 3; i++) node[i].number(range);
    return;
  }
  if (s.kind == SpectrumKind::Rgb) {
    for (int i = 0; i < 3; i++)
      if (!range.contains(s.rgb[i] * s.scale)) node.fail("the component " + show(s.rgb[i] * s.scale) + " " + range.text());
    return;
  }
  if (s.kind == SpectrumKind::Sampled && node.is_object() && s.scale == 1 && node.json().contains("values")) {
    for (std::size_t i = 0; i < s.values.size(); i++) node.child("values")[i].number(range);
    return;
  }
  const auto check_at = [&](double lambda) {
    const double value = plain_value(s, role, lambda);
    if (!std::isfinite(value)) node.fail("the value at " + show(lambda) + " nm is not finite");
    if (!range.contains(value)) node.fail("the value at " + show(lambda) + " nm, about " + show(value, 6) + ", " + range.text());
  };
  for (int lambda = 280; lambda <= 780; lambda++) check_at(lambda);
  for (const double lambda : s.wavelengths)
    if (lambda > 280 && lambda < 780) check_at(lambda);
}

double sampled_value(const Spectrum& s, SpectrumRole role, double lambda) {
  const bool zero = s.extrapolate == Extrapolate::Zero ||
                    (s.extrapolate == Extrapolate::Default && (role == SpectrumRole::Emission || role == SpectrumRole::Dye));
  const auto& w = s.wavelengths;
  if (lambda < w.front()) return zero ? 0 : s.values.front();
  if (lambda > w.back()) return zero ? 0 : s.values.back();
  const std::size_t i = std::upper_bound(w.begin(), w.end(), lambda) - w.begin();
  if (i == w.size()) return s.values.back();
  const double f = (lambda - w[i - 1]) / (w[i] - w[i - 1]);
  return s.values[i - 1] + f * (s.values[i] - s.values[i - 1]);
}

double unscaled_value(const Spectrum& s, SpectrumRole role, double lambda) {
  const double um2 = lambda * lambda * 1e-6;
  switch (s.kind) {
    case SpectrumKind::Number:
    case SpectrumKind::Constant:
      return s.value;
    case SpectrumKind::Rgb:
      return std::max({s.rgb.x, s.rgb.y, s.rgb.z});
    case SpectrumKind::Sampled:
      return sampled_value(s, role, lambda);
    case SpectrumKind::Box:
      return lambda >= s.a && lambda < s.b ? s.value : 0;
    case SpectrumKind::Gaussian:
      return s.value * std::exp(-0.5 * (lambda - s.a) * (lambda - s.a) / (s.b * s.b));
    case SpectrumKind::Blackbody:
    case SpectrumKind::Illuminant:
      return 1;
    case SpectrumKind::Cauchy:
      return s.a + s.b / um2;
    case SpectrumKind::Sellmeier: {
      double n2 = 1;
      for (int i = 0; i < 3; i++) n2 += s.sellmeier_b[i] * um2 / (um2 - s.sellmeier_c[i]);
      return std::sqrt(n2);
    }
    case SpectrumKind::Product: {
      double product = 1;
      for (const SpectrumPtr& factor : s.of) product *= plain_value(*factor, role, lambda);
      return product;
    }
    case SpectrumKind::Sum: {
      double sum = 0;
      for (const SpectrumPtr& term : s.of) sum += plain_value(*term, role, lambda);
      return sum;
    }
  }
  return 0;
}

}  // namespace

double plain_value(const Spectrum& s, SpectrumRole role, double lambda) { return s.scale * unscaled_value(s, role, lambda); }

bool is_spectrum_type(const std::string& canonical_type) { return forms().count(canonical_type) > 0; }

const std::vector<std::string>& spectrum_types() {
  static const std::vector<std::string> types = [] {
    std::vector<std::string> names;
    for (const auto& form : forms()) names.push_back(form.first);
    return names;
  }();
  return types;
}

SpectrumPtr make_number_spectrum(double value, const std::string& pointer) {
  auto s = std::make_shared<Spectrum>();
  s->value = value;
  s->pointer = pointer;
  return s;
}

SpectrumPtr read_spectrum(ReadContext& context, const JsonNode& node, SpectrumRole role, const Range& range) {
  const SpectrumPtr s = node.is_string() ? context.spectra.resolve(node) : read_inline(context, node, role);
  check_range(node, *s, role, range);
  return s;
}

void read_named_spectra(ReadContext& context, const JsonNode& list) {
  if (!list.is_array()) list.fail_type("an array of named spectra");
  context.require_within(list, list.size(), &InputLimits::spectra);
  for (std::size_t i = 0; i < list.size(); i++) {
    const JsonNode node = list[i];
    if (!node.is_object()) node.fail_type("a spectrum with a name");
    const bool illuminant = type_of(node, "a spectrum") == "illuminant";
    // An illuminant's "name" says which it is, and serves as its name too.
    auto s = read_object(context, node, SpectrumRole::Reflectance);
    if (illuminant) s->name = s->illuminant;
    if (s->name.empty()) node.fail("an entry of \"spectra\" needs a \"name\"");
    context.spectra.add(node.child("name"), s->name, s);
    context.scene.spectra.push_back(s);
  }
}

}  // namespace stokes
