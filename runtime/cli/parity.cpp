// `stokes parity`: the OpenCL renderer against the CPU reference, scene by scene and device by device.
#include "image/parity.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/overwriting.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/render_job.h"
#include "cli/scene_options.h"
#include "device/error.h"
#include "image/replace_file.h"
#include "view/report.h"

namespace stokes {
namespace {

struct ParityCommand {
  std::vector<std::string> scenes;
  std::string devices = "auto";
  std::string html, spectral;
  SceneOptions scene_options;
  ParityOptions parity;
  bool json = false;
};

class Interrupted : public std::exception {};

std::vector<std::string> device_specs(const std::string& text) {
  if (text != "all") return split(text, ',');
  std::vector<std::string> specs;
  for (const DeviceInfo& d : list_devices())
    if (d.usable) specs.push_back(std::to_string(d.platform) + ":" + std::to_string(d.device));
  if (specs.empty()) throw DeviceError("no OpenCL device is usable");
  return specs;
}

/// The whole image of a scene on one device. `at_powers`, where given, sees it at 1, 2, 4, ... samples per pixel and at the end.
FilmRecord render_film(const LoadedScene& scene, const SceneOptions& options, const std::function<void(const FilmRecord&)>& at_powers = {}) {
  const auto backend = make_backend(scene.compiled, scene.device, {options.threads, options.kernel_dir});
  RenderJob job;
  job.backend = backend.get();
  job.record = scene.empty_record(scene.whole());
  for (int end = at_powers ? 1 : scene.compiled.samples; job.sample_end < scene.compiled.samples; end *= 2) {
    job.sample_end = std::min(end, scene.compiled.samples);
    if (run_job(job) == RenderEnd::Interrupted) throw Interrupted();
    if (at_powers) at_powers(job.record);
  }
  const std::string invalid = describe_invalid(job.record, *backend);
  if (!invalid.empty()) std::fprintf(stderr, "warning: %s on %s: %s\n", scene.path.c_str(), scene.device.name().c_str(), invalid.c_str());
  return job.record;
}

/// One scene on one device against the truth, with what the page shows of it where a page is wanted.
ReportCase compare_device(const ParityCommand& o, const std::string& path, const LoadedScene& scene, const SceneOptions& options, const FilmRecord& truth,
                          const ParityOptions& parity) {
  ReportCase c;
  const bool page = !o.html.empty();
  const FilmRecord record = render_film(scene, options, !page ? std::function<void(const FilmRecord&)>() : [&](const FilmRecord& r) {
    c.convergence.push_back({r.sample_end, convergence_error(r.film, truth.film)});
  });
  c.parity = test_parity(estimate_of(record.film), estimate_of(truth.film), parity);
  c.different = !c.parity->agree;
  c.name_a = scene.device.name();
  c.name_b = "reference";
  c.name = path + " on " + c.name_a;
  if (!page) return c;
  c.a = picture(record, true);
  c.b = picture(truth, true);
  c.difference = compare_images(c.a, c.b);
  return c;
}

nlohmann::ordered_json to_json(const std::string& scene, const std::string& device, const ParityResult& r) {
  nlohmann::ordered_json j;
  j["scene"] = scene;
  j["device"] = device;
  j["agree"] = r.agree;
  j["tests"] = r.tests;
  j["block"] = r.block;
  j["largest_z"] = std::fabs(r.worst.z);
  j["threshold_z"] = r.threshold;
  j["p"] = r.p;
  for (const ParityTest& t : r.means) j["means"][t.channel] = {{"device", t.mean_a}, {"reference", t.mean_b}, {"z", t.z}};
  j["rejected"] = nlohmann::ordered_json::array();
  for (const ParityTest& t : r.rejected)
    j["rejected"].push_back({{"channel", t.channel}, {"x", t.x}, {"y", t.y}, {"width", t.width}, {"height", t.height}, {"device", t.mean_a}, {"reference", t.mean_b}, {"z", t.z}});
  return j;
}

int compare_all(const ParityCommand& o) {
  const std::vector<std::string> devices = device_specs(o.devices);
  // All comparisons together shall reject equal renders with probability alpha.
  ParityOptions options = o.parity;
  options.alpha = -std::expm1(std::log1p(-options.alpha) / static_cast<double>(o.scenes.size() * devices.size()));
  const SpectralBins bins = o.spectral.empty() ? SpectralBins{} : parse_spectral(o.spectral);
  require_no_other_file(o.html);
  if (!o.html.empty()) require_writable(o.html);
  bool agree = true;
  std::vector<ReportCase> cases;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& path : o.scenes) {
    SceneOptions scene_options = o.scene_options;
    scene_options.device = "reference";
    const LoadedScene on_reference = load_scene(path, scene_options, {}, bins, false);
    if (on_reference.compiled.samples < 2) throw UsageError("--spp: parity needs at least 2 samples per pixel, to know the noise");
    const FilmRecord truth = render_film(on_reference, scene_options);
    for (const std::string& device : devices) {
      scene_options.device = device;
      const LoadedScene on_device = load_scene(path, scene_options, {}, bins, true);
      cases.push_back(compare_device(o, path, on_device, scene_options, truth, options));
      const ParityResult& result = *cases.back().parity;
      agree &= result.agree;
      list.push_back(to_json(path, on_device.device.name(), result));
      if (!o.json) std::printf("%s on %s: %s", path.c_str(), on_device.device.name().c_str(), describe(result).c_str());
      std::fflush(stdout);
    }
  }
  if (!o.html.empty()) write_bytes(o.html, comparison_report("Parity with the reference", cases));
  if (o.json) std::cout << list.dump(2) << "\n";
  return agree ? kExitDone : kExitDifferent;
}

int run_parity(const ParityCommand& o) {
  catch_interrupts();
  try {
    return compare_all(o);
  } catch (const Interrupted&) {
    std::fprintf(stderr, "interrupted\n");
    return kExitInterrupted;
  }
}

}  // namespace

Command add_parity(CLI::App& root) {
  auto o = std::make_shared<ParityCommand>();
  CLI::App* app = root.add_subcommand("parity", "Renders scenes on OpenCL devices and by the CPU reference, and tests whether they agree (exit code 7 if not)");
  app->add_option("scenes", o->scenes, "SCENE.json ...")->required();
  app->add_option("--devices", o->devices, "all, or a comma-separated list of devices as in render --device")->capture_default_str();
  app->add_option("--alpha", o->parity.alpha, "Probability that equal renders are called different, over all scenes and devices")
      ->capture_default_str()->check(CLI::Range(1e-12, 0.5));
  app->add_option("--block", o->parity.block, "Edge of the pixel blocks tested; 0: by the samples")->capture_default_str()->check(CLI::Range(0, 4096));
  SceneOptions& s = o->scene_options;
  app->add_option("--spp", s.samples, "Samples per pixel [the scene's, else 16]")->check(CLI::Range(2, 1 << 30));
  app->add_option("--seed", s.seed, "Seed of the random numbers [the scene's, else 0]");
  app->add_option("--size", s.size, "WIDTHxHEIGHT of the image [the scene's]");
  app->add_option("--integrator", s.integrator, "mis, nee, mats, normals, ao [the scene's, else mis]");
  app->add_option("--mode", s.mode, "spectral or rgb [the scene's, else spectral]")->check(CLI::IsMember({"spectral", "rgb"}));
  app->add_option("--wavelengths-per-path", s.wavelengths_per_path, "1, 4 or 8 [the scene's, else 4]")->check(CLI::IsMember({1, 4, 8}));
  app->add_option("--set", s.settings, "/json/pointer=VALUE: changes a value of the scene files; may be given again")->take_all();
  app->add_option("--threads", s.threads, "CPU threads; 0 is all")->capture_default_str()->check(CLI::Range(0, 4096));
  app->add_option("--kernel-dir", s.kernel_dir, "Read the kernels from this folder")->check(CLI::ExistingDirectory);
  app->add_option("--html", o->html, "FILE: one page with both pictures under a slider, maps, convergence and the numbers");
  app->add_option("--spectral", o->spectral, "a:b:n: render n spectral bins, too, for the page's spectra [none]");
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_parity(*o); }};
}

}  // namespace stokes
