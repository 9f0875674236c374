// Homogeneous media: two of four coefficients, the phase function, the unit.
#include "scene/medium_reader.h"

#include <cmath>

#include "scene/material_reader.h"
#include "scene/spectrum_reader.h"

namespace stokes {
namespace {

constexpr Range kAnisotropy{-1, 1, true, true};

SpectrumPtr read_g(ReadContext& context, const JsonNode& node) {
  const SpectrumPtr g = read_spectrum(context, node, SpectrumRole::Coefficient, kAnisotropy);
  return node.is_number() && g->value == 0 ? nullptr : g;
}

// "phase function": {"type": "hg", "g": ...}, {"type": "isotropic"}, or either name alone.
SpectrumPtr read_phase_function(ReadContext& context, const JsonNode& node) {
  const JsonNode type_node = node.is_string() ? node : JsonObject(node, "a phase function", {"type", "g"}).require("type");
  const std::string type = canonical_type(type_node.string());
  const auto g = node.is_object() ? JsonObject(node, "a phase function", {"type", "g"}).find("g") : std::nullopt;
  if (type == "isotropic") {
    if (g) g->fail_at_key("an isotropic phase function has no g");
    return nullptr;
  }
  if (type != "hg" && type != "henyey greenstein")
    type_node.fail("no phase function has the type \"" + type_node.string() + "\"" +
                   did_you_mean(type, {"hg", "henyey_greenstein", "isotropic"}));
  return g ? read_g(context, *g) : nullptr;
}

// Which of the four coefficients stand, and whether they determine the others.
void check_pair(const JsonNode& node, const MediumDescription& m) {
  const int count = (m.sigma_t != nullptr) + (m.sigma_s != nullptr) + (m.sigma_a != nullptr) + (m.albedo != nullptr);
  if (count != 2) node.fail("a medium needs exactly two of sigma_t, sigma_s, sigma_a and albedo, not " + std::to_string(count));
  for (int lambda = 280; lambda <= 780; lambda++) {
    const auto at = [&](const SpectrumPtr& s) { return s ? plain_value(*s, SpectrumRole::Coefficient, lambda) : 0.0; };
    const std::string where = " at " + std::to_string(lambda) + " nm";
    if (m.sigma_t && m.sigma_s && at(m.sigma_s) > at(m.sigma_t) * (1 + 1e-9))
      node.fail("sigma_s " + show(at(m.sigma_s)) + " is greater than sigma_t " + show(at(m.sigma_t)) + where);
    if (m.sigma_t && m.sigma_a && at(m.sigma_a) > at(m.sigma_t) * (1 + 1e-9))
      node.fail("sigma_a " + show(at(m.sigma_a)) + " is greater than sigma_t " + show(at(m.sigma_t)) + where);
    if (m.sigma_s && m.albedo && at(m.albedo) == 0 && at(m.sigma_s) > 0) node.fail("an albedo of 0" + where + " contradicts sigma_s");
    if (m.sigma_s && m.albedo && at(m.albedo) == 0) node.fail("sigma_s and albedo of 0" + where + " do not determine sigma_t");
    if (m.sigma_a && m.albedo && at(m.albedo) == 1) node.fail("sigma_a and an albedo of 1" + where + " do not determine sigma_t");
  }
}

SpectrumPtr times(const SpectrumPtr& s, double factor) {
  if (factor == 1) return s;
  auto scaled = std::make_shared<Spectrum>(*s);
  scaled->scale *= factor;
  return scaled;
}

void read_coefficients(ReadContext& context, const JsonObject& o, MediumDescription& m) {
  const auto coefficient = [&](const char* key) -> SpectrumPtr {
    const auto node = o.find(key);
    return node ? read_spectrum(context, *node, SpectrumRole::Coefficient, kNotNegative) : nullptr;
  };
  m.sigma_t = coefficient("sigma_t");
  m.sigma_s = coefficient("sigma_s");
  m.sigma_a = coefficient("sigma_a");
  if (const auto total = o.find("total")) {
    if (m.sigma_t) total->fail_at_key("\"total\" and \"sigma_t\" are the same thing: give one of them");
    m.sigma_t = coefficient("total");
  }
  if (const auto albedo = o.find("albedo")) m.albedo = read_spectrum(context, *albedo, SpectrumRole::Coefficient, kUnitInterval);
  // darts' own default, where its own key asks for it.
  if (o.has("total") && !m.sigma_s && !m.sigma_a && !m.albedo) m.albedo = make_number_spectrum(0.8, o.node().pointer());
  check_pair(o.node(), m);
  const double fraction = o.number("real fraction", 1, kUnitInterval);
  if (m.sigma_t) m.sigma_t = times(m.sigma_t, fraction);
  if (m.sigma_s) m.sigma_s = times(m.sigma_s, fraction);
  if (m.sigma_a) m.sigma_a = times(m.sigma_a, fraction);
}

MediumPtr read_inline(ReadContext& context, const JsonNode& node) {
  const std::string type = type_of(node, "a medium");
  auto m = std::make_shared<MediumDescription>();
  m->pointer = node.pointer();
  if (type == "vacuum") {
    // darts wants a phase function even here.
    const JsonObject o(node, "a vacuum", {"type", "name", "phase function"});
    m->vacuum = true;
    m->name = o.string("name", "");
    return m;
  }
  const JsonNode type_node = node.child("type");
  if (type != "homogeneous" && type != "homogeneous hg")
    type_node.fail("no medium has the type \"" + type_node.string() + "\"" +
                   did_you_mean(type_node.string(), {"homogeneous", "homogeneous_hg", "vacuum"}));
  const JsonObject o(
      node, "a homogeneous medium",
      {"type", "name", "sigma_t", "sigma_s", "sigma_a", "albedo", "total", "real fraction", "g", "phase function", "unit", "dyes"});
  m->name = o.string("name", "");
  read_coefficients(context, o, *m);
  const auto g = o.find("g"), phase = o.find("phase function");
  if (g && phase) g->fail_at_key("g stands in the phase function or beside it, not both");
  if (g) m->g = read_g(context, *g);
  if (phase) m->g = read_phase_function(context, *phase);
  if (const auto unit = o.find("unit")) {
    m->unit = read_length_unit(*unit);
    if (context.scene.scene_unit == LengthUnit::None)
      context.warn(*unit, "without a \"scene unit\" at the top level the coefficients are taken per scene unit");
  }
  if (const auto dyes = o.find("dyes")) m->dyes = read_dyes(context, *dyes, true);
  return m;
}

}  // namespace

LengthUnit read_length_unit(const JsonNode& node) {
  const std::string unit = node.string();
  if (unit == "m") return LengthUnit::Metre;
  if (unit == "cm") return LengthUnit::Centimetre;
  if (unit == "mm") return LengthUnit::Millimetre;
  node.fail("expected \"m\", \"cm\" or \"mm\", not \"" + unit + "\"");
}

MediumPtr read_medium(ReadContext& context, const JsonNode& node) {
  if (node.json().is_null()) return nullptr;
  if (node.is_string()) {
    const std::string name = node.string();
    if ((name == "vacuum" || name == "air") && !context.media.find(name)) return nullptr;
    return context.media.resolve(node);
  }
  if (!node.is_object()) node.fail_type("a medium or the name of one");
  return read_inline(context, node);
}

void read_named_media(ReadContext& context, const JsonNode& list) {
  if (!list.is_array()) list.fail_type("an array of media");
  context.require_within(list, list.size(), &InputLimits::media);
  for (std::size_t i = 0; i < list.size(); i++) {
    const MediumPtr m = read_inline(context, list[i]);
    if (m->name.empty()) list[i].fail("an entry of \"media\" needs a \"name\"");
    context.media.add(list[i].child("name"), m->name, m);
    context.scene.media.push_back(m);
  }
}

}  // namespace stokes
