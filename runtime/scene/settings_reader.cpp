// Camera, sampler, integrator, background and film.
#include "scene/settings_reader.h"

#include <algorithm>
#include <sstream>

#include "scene/medium_reader.h"
#include "scene/spectrum_reader.h"
#include "scene/texture_reader.h"
#include "scene/transform_reader.h"

namespace stokes {
namespace {

const std::vector<std::string> kIntegrators = {"path tracer mats",
                                               "path tracer nee",
                                               "path tracer mis",
                                               "path tracer volumetric",
                                               "path tracer volumetric mats",
                                               "path tracer volumetric nee",
                                               "path tracer volumetric mis",
                                               "fluorescent mats",
                                               "fluorescent nee",
                                               "fluorescent mis",
                                               "normals",
                                               "ao"};

// `volumetric` alone is the report's basic tracer. darts' one-sample mixture has the same mean as MIS.
std::optional<IntegratorKind> integrator_kind(const std::string& type) {
  if (type == "normals") return IntegratorKind::Normals;
  if (type == "ao") return IntegratorKind::Ao;
  std::istringstream words(type);
  std::string word, last;
  bool volumetric = false, named = false;
  while (words >> word) {
    if (!last.empty()) return std::nullopt;                       // the estimator is the last word
    const bool media = word == "volumetric" || word == "volume";  // darts' exporter says "volume path tracer mis"
    if (word == "path" || word == "tracer" || word == "fluorescent" || media) {
      named = true;
      volumetric |= media;
    } else {
      last = word;
    }
  }
  if (!named) return std::nullopt;
  if (last == "mats" || (last.empty() && volumetric)) return IntegratorKind::Mats;
  if (last == "nee") return IntegratorKind::Nee;
  if (last == "mis" || last == "mixture" || last.empty()) return IntegratorKind::Mis;
  return std::nullopt;
}

std::optional<int> read_russian_roulette(const JsonNode& node) {
  if (!node.json().is_boolean()) return static_cast<int>(node.integer(0, 1'000'000'000));
  return node.boolean() ? IntegratorDescription{}.russian_roulette : std::nullopt;
}

}  // namespace

CameraDescription read_camera(ReadContext& context, const JsonNode& node) {
  const JsonObject o(node, "a camera", {"type", "transform", "vfov", "fdist", "aperture", "resolution", "height", "medium"});
  CameraDescription c;
  c.pointer = node.pointer();
  const std::string type = canonical_type(o.string("type", "perspective"));
  c.orthographic = type == "orthographic";
  if (!c.orthographic && type != "perspective" && type != "pinhole" && type != "thin lens")
    o.require("type").fail("no camera has the type \"" + type + "\"" + did_you_mean(type, {"perspective", "orthographic"}));
  if (const auto transform = o.find("transform")) c.transform = read_transform(*transform);
  if (const auto vfov = o.find("vfov"); vfov && c.orthographic) vfov->fail_at_key("an orthographic camera has a \"height\" and no vfov");
  if (const auto height = o.find("height"); height && !c.orthographic)
    height->fail_at_key("only an orthographic camera has a height: give its \"type\"");
  c.vfov = o.number("vfov", c.vfov, {0, 180, true, true});
  c.height = o.number("height", c.height, kPositive);
  c.fdist = o.number("fdist", c.fdist, kPositive);
  c.aperture = o.number("aperture", c.aperture, kNotNegative);
  if (const auto resolution = o.find("resolution")) {
    resolution->numbers(2);
    const auto side = static_cast<long long>(std::min<std::uint64_t>(context.limits.side, 1u << 30));
    c.width = static_cast<int>((*resolution)[0].integer(1, side));
    c.height_pixels = static_cast<int>((*resolution)[1].integer(1, side));
    context.require_within(*resolution, static_cast<std::uint64_t>(c.width) * static_cast<std::uint64_t>(c.height_pixels), &InputLimits::pixels);
  }
  if (const auto medium = o.find("medium")) c.medium = read_medium(context, *medium);
  return c;
}

void read_sampler(ReadContext& context, const JsonNode& node) {
  const JsonObject o(node, "a sampler", {"type", "samples", "seed"});
  o.string("type", "");
  if (const auto samples = o.find("samples")) {
    context.scene.samples = static_cast<int>(samples->integer(1, 2147483647));
    context.require_within(*samples, static_cast<std::uint64_t>(context.scene.samples), &InputLimits::samples);
  }
  if (const auto seed = o.find("seed")) context.scene.seed = static_cast<std::uint32_t>(seed->integer(0, 4294967295LL));
}

IntegratorDescription read_integrator(const JsonNode& node) {
  // `recursive` and `power` steer how darts computes the same mean.
  const JsonObject o(node, "an integrator",
                     {"type", "max bounces", "russian roulette", "wavelengths per path", "mode", "equiangular", "recursive", "power"});
  IntegratorDescription i;
  if (const auto type = o.find("type")) {
    i.name = type->string();
    const auto kind = integrator_kind(canonical_type(i.name));
    if (!kind) type->fail("no integrator is called \"" + i.name + "\"" + did_you_mean(i.name, kIntegrators));
    i.kind = *kind;
  }
  if (const auto bounces = o.find("max bounces")) i.max_bounces = static_cast<int>(bounces->integer(0, 1'000'000'000));
  if (const auto roulette = o.find("russian roulette")) i.russian_roulette = read_russian_roulette(*roulette);
  if (const auto wavelengths = o.find("wavelengths per path")) {
    i.wavelengths_per_path = static_cast<int>(wavelengths->integer(1, 8));
    if (i.wavelengths_per_path != 1 && i.wavelengths_per_path != 4 && i.wavelengths_per_path != 8)
      wavelengths->fail(wavelengths->json().dump() + " is none of 1, 4 and 8");
  }
  i.equiangular = o.boolean("equiangular", i.equiangular);
  if (const auto mode = o.find("mode")) {
    const std::string name = mode->string();
    if (name != "spectral" && name != "rgb") mode->fail("expected \"spectral\" or \"rgb\", not \"" + name + "\"");
    i.mode = name == "rgb" ? ColorMode::Rgb : ColorMode::Spectral;
  }
  return i;
}

BackgroundDescription read_background(ReadContext& context, const JsonNode& node) {
  BackgroundDescription b;
  b.pointer = node.pointer();
  if (!node.is_object() || type_of(node, "a background") != "environment") {
    if (node.is_object() && !is_spectrum_type(type_of(node, "a background"))) {
      std::vector<std::string> names = spectrum_types();
      names.push_back("environment");
      const JsonNode type = node.child("type");
      type.fail("no background has the type \"" + type.string() + "\"" + did_you_mean(type.string(), names));
    }
    b.emission = read_spectrum(context, node, SpectrumRole::Emission, kNotNegative);
    return b;
  }
  const JsonObject o(node, "an environment map", {"type", "filename", "rotate", "scale"});
  const JsonNode filename = o.require("filename");
  b.environment = read_image(context, filename, false);
  for (const float v : b.environment->rgb)
    if (v < 0) filename.fail("the environment map has negative pixels");
  b.rotate = o.number("rotate", 0);
  b.scale = o.number("scale", 1, kNotNegative);
  return b;
}

void read_film(ReadContext& context, const JsonNode& node) {
  const JsonObject o(node, "a film", {"spectral"});
  const auto spectral = o.find("spectral");
  if (!spectral) return;
  const auto numbers = spectral->numbers(3);
  SpectralBinsDescription bins;
  bins.begin = (*spectral)[0].number({280, 780});
  bins.end = (*spectral)[1].number({280, 780});
  bins.count = static_cast<int>((*spectral)[2].integer(1, 500));
  if (!(bins.begin < bins.end)) spectral->fail("the bins must begin below their end");
  context.scene.spectral_bins = bins;
}

}  // namespace stokes
