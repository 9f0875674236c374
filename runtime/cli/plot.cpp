// `stokes plot`: spectra of an expression, a scene or one of its materials as curves, with samples drawn from them.
#include "spectral/plot.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/scene_options.h"
#include "image/error.h"
#include "image/image_file.h"
#include "image/replace_file.h"
#include "scene/read_scene.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

constexpr int kSamples = 20000;  // of each curve of a fluorescent material, where the user asks for no number

struct PlotOptions {
  SceneOptions scene_options;  // of these only the limits
  std::string what, output, role = "reflectance";
  int samples = -1, width = 960, height = 540;
};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

SpectrumRole parse_role(const std::string& name) {
  if (name == "emission") return SpectrumRole::Emission;
  if (name == "index") return SpectrumRole::Index;
  if (name == "coefficient") return SpectrumRole::Coefficient;
  if (name == "dye") return SpectrumRole::Dye;
  return SpectrumRole::Reflectance;
}

/// A plot, and which of its curves are a dye's: densities that wavelengths are drawn from.
struct Drawing {
  Plot plot;
  std::vector<std::size_t> dyes;
};

void add_curve(Plot& plot, const std::string& name, const SpectrumPtr& spectrum, SpectrumRole role) {
  if (spectrum) plot.curves.push_back({name, tabulate(*spectrum, role), {}});
}

void add_dyes(Drawing& drawing, const std::string& name, const std::vector<DyeDescription>& dyes) {
  for (std::size_t i = 0; i < dyes.size(); i++) {
    const std::string dye = name + (dyes.size() > 1 ? " dye " + std::to_string(i) : "");
    for (const auto& [curve, spectrum] : {std::pair(" absorption", dyes[i].absorption), std::pair(" emission", dyes[i].emission)}) {
      drawing.dyes.push_back(drawing.plot.curves.size());
      add_curve(drawing.plot, dye + curve, spectrum, SpectrumRole::Dye);
    }
  }
}

void add_material(Drawing& drawing, const MaterialDescription& m) {
  Plot& plot = drawing.plot;
  const std::string name = m.name.empty() ? m.pointer : m.name;
  add_curve(plot, name + " albedo", m.albedo.spectrum, SpectrumRole::Reflectance);
  add_curve(plot, name + " index", m.ior, SpectrumRole::Index);
  add_curve(plot, name + " eta", m.eta, SpectrumRole::Index);
  add_curve(plot, name + " k", m.k, SpectrumRole::Index);
  add_curve(plot, name + " emission", m.emit, SpectrumRole::Emission);
  add_dyes(drawing, name, m.dyes);
  for (const MaterialPtr& child : {m.a, m.b})
    if (child) add_material(drawing, *child);
}

void add_medium(Drawing& drawing, const MediumDescription& m) {
  Plot& plot = drawing.plot;
  const std::string name = m.name.empty() ? m.pointer : m.name;
  add_curve(plot, name + " sigma_t", m.sigma_t, SpectrumRole::Coefficient);
  add_curve(plot, name + " sigma_s", m.sigma_s, SpectrumRole::Coefficient);
  add_curve(plot, name + " sigma_a", m.sigma_a, SpectrumRole::Coefficient);
  add_curve(plot, name + " albedo", m.albedo, SpectrumRole::Coefficient);
  add_curve(plot, name + " g", m.g, SpectrumRole::Coefficient);
  add_dyes(drawing, name, m.dyes);
}

/// All named things of a scene, or the one called `wanted`.
Drawing plot_scene(const std::string& path, const std::string& wanted, const InputLimits& limits) {
  const SceneDescription scene = read_scene(path, {}, {limits, {}});
  Drawing drawing;
  Plot& plot = drawing.plot;
  plot.title = fs::path(path).filename().string() + (wanted.empty() ? "" : "#" + wanted);
  std::string names;
  const auto take = [&](const std::string& name) {
    if (!name.empty()) names += (names.empty() ? "" : ", ") + name;
    return wanted.empty() || name == wanted;
  };
  for (const SpectrumPtr& s : scene.spectra)
    if (take(s->name)) add_curve(plot, s->name, s, SpectrumRole::Reflectance);
  for (const MediumPtr& m : scene.media)
    if (take(m->name)) add_medium(drawing, *m);
  for (const MaterialPtr& m : scene.materials)
    if (take(m->name)) add_material(drawing, *m);
  if (plot.curves.empty())
    throw InputError(path + ": " + (wanted.empty() ? "has no named spectrum, medium or material" : "has no curves named '" + wanted + "'; it has: " + names));
  return drawing;
}

/// The scene format's JSON of an expression: JSON itself, a CSV file's name, an illuminant's name, `blackbody:5000`,
/// `gaussian:MEAN:STDDEV`, or `box:FROM:TO`.
std::string expression_json(const std::string& text) {
  const std::size_t first = text.find(':');
  const std::string head = text.substr(0, first);
  const auto number_after = [&](std::size_t colon) { return text.substr(colon + 1, text.find(':', colon + 1) - colon - 1); };
  if (ends_with(text, ".csv")) return nlohmann::json{{"type", "file"}, {"filename", fs::absolute(text).string()}}.dump();
  if (text == "D65" || text == "A" || text == "E" || text == "F11") return nlohmann::json{{"type", "illuminant"}, {"name", text}}.dump();
  if (head == "blackbody" && first != std::string::npos) return "{\"type\":\"blackbody\",\"temperature\":" + number_after(first) + "}";
  const std::size_t second = first == std::string::npos ? first : text.find(':', first + 1);
  if (head == "gaussian" && second != std::string::npos)
    return "{\"type\":\"gaussian\",\"mean\":" + number_after(first) + ",\"stddev\":" + number_after(second) + ",\"value\":1}";
  if (head == "box" && second != std::string::npos)
    return "{\"type\":\"box\",\"range\":[" + number_after(first) + "," + number_after(second) + "],\"value\":1}";
  return text;
}

Drawing plot_expression(const PlotOptions& o) {
  const std::string json = expression_json(o.what);
  if (!nlohmann::json::accept(json))
    throw UsageError("plot: '" + o.what + "' is neither a scene (.json), a curve (.csv), an illuminant (D65, A, E, F11), blackbody:K, gaussian:MEAN:STDDEV, "
                     "box:FROM:TO, nor a spectrum in the scene format's JSON");
  // A sum of one holds any form of spectrum, numbers and [r, g, b] included.
  InputLimits limits = o.scene_options.input_limits();
  limits.allow_outside = true;  // who types a file's name means it
  const std::string text = "{\"camera\":{},\"spectra\":[{\"name\":\"it\",\"type\":\"sum\",\"of\":[" + json + "]}]}";
  const SceneDescription scene = read_scene_text(text, "expression", ".", {}, {limits, {}});
  Drawing drawing;
  Plot& plot = drawing.plot;
  plot.title = o.what;
  const bool light = json.find("\"illuminant\"") != std::string::npos || json.find("\"blackbody\"") != std::string::npos;
  add_curve(plot, o.what, scene.spectra.front(), light ? SpectrumRole::Emission : parse_role(o.role));
  return drawing;
}

/// Draws `count` wavelengths from each curve, or of a scene with dyes from the dyes' curves alone, as both integrators sample spectra: a cell by
/// the cumulative table, then exactly the linear density inside it.
void draw_samples(Drawing& drawing, int count) {
  std::mt19937_64 random(0);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<std::size_t> densities = drawing.dyes;
  if (densities.empty())
    for (std::size_t i = 0; i < drawing.plot.curves.size(); i++) densities.push_back(i);
  for (const std::size_t i : densities) {
    PlotCurve& curve = drawing.plot.curves[i];
    const TableDistribution distribution = make_distribution(curve.table);
    if (distribution.integral <= 0) continue;
    for (int n = 0; n < count; n++) curve.samples.push_back(static_cast<float>(sample_distribution(curve.table, distribution, uniform(random))));
  }
}

void write_pixels(const std::string& path, const Pixels& pixels) {
  Image image;
  image.width = pixels.width;
  image.height = pixels.height;
  for (std::size_t c = 0; c < 3; c++) {
    Image::Channel channel{std::string(1, "RGB"[c]), {}};
    for (std::size_t i = c; i < pixels.rgb.size(); i += 3) channel.values.push_back(static_cast<float>(srgb_decode(pixels.rgb[i] / 255.0)));
    image.channels.push_back(std::move(channel));
  }
  write_png(path, image, 0);
}

int run_plot(PlotOptions o) {
  const std::size_t hash = o.what.find(".json#");
  const bool is_scene = hash != std::string::npos || ends_with(o.what, ".json");
  const std::string path = hash == std::string::npos ? o.what : o.what.substr(0, hash + 5);
  if (o.output.empty()) o.output = (is_scene ? fs::path(path).stem().string() : "spectrum") + ".svg";
  if (!ends_with(o.output, ".svg") && !ends_with(o.output, ".png")) throw UsageError("-o: '" + o.output + "' ends in neither .svg nor .png");
  require_writable(o.output);
  Drawing drawing = is_scene ? plot_scene(path, hash == std::string::npos ? "" : o.what.substr(hash + 6), o.scene_options.input_limits()) : plot_expression(o);
  const bool fluoresces = hash != std::string::npos && !drawing.dyes.empty();
  const int samples = o.samples >= 0 ? o.samples : fluoresces ? kSamples : 0;
  if (samples > 0) draw_samples(drawing, samples);
  const Plot& plot = drawing.plot;
  if (ends_with(o.output, ".svg"))
    write_bytes(o.output, plot_svg(plot, o.width, o.height));
  else
    write_pixels(o.output, plot_pixels(plot, o.width, o.height));
  std::cout << o.output << "\n";
  return kExitDone;
}

}  // namespace

Command add_plot(CLI::App& root) {
  auto o = std::make_shared<PlotOptions>();
  CLI::App* app = root.add_subcommand("plot", "Draws spectra: of an expression, of a scene, or of one of its spectra, media or materials");
  app->add_option("what", o->what, "SCENE.json, SCENE.json#NAME, FILE.csv, D65, A, E, F11, blackbody:K, gaussian:MEAN:STDDEV, box:FROM:TO, or JSON")->required();
  app->add_option("-o,--output", o->output, "OUT.svg or .png [the scene's name or spectrum, with .svg]");
  app->add_option("--samples", o->samples, "Also draw this many wavelengths from each curve (of a scene with dyes: the dyes' curves), as a histogram [20000 for SCENE#NAME with dyes, else 0]")
      ->check(CLI::Range(0, 100000000));
  app->add_option("--role", o->role, "How an expression is used: reflectance, emission, index, coefficient, dye")
      ->capture_default_str()->check(CLI::IsMember({"reflectance", "emission", "index", "coefficient", "dye"}));
  o->scene_options.add_limits_to(*app);
  app->add_option("--width", o->width, "Pixels")->capture_default_str()->check(CLI::Range(200, 10000));
  app->add_option("--height", o->height, "Pixels")->capture_default_str()->check(CLI::Range(150, 10000));
  return {app, [o] { return run_plot(*o); }};
}

}  // namespace stokes
