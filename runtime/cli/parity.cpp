// `stokes parity`: the OpenCL renderer against the CPU reference, scene by scene and device by device.
#include "image/parity.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/render_job.h"
#include "cli/scene_options.h"
#include "device/error.h"

namespace stokes {
namespace {

struct ParityCommand {
  std::vector<std::string> scenes;
  std::string devices = "auto";
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

/// The whole image of a scene on one device.
Film render_film(const LoadedScene& scene, const SceneOptions& options) {
  const auto backend = make_backend(scene.compiled, scene.device, {options.threads, options.kernel_dir});
  RenderJob job;
  job.backend = backend.get();
  job.record.film = scene.empty_film(scene.whole());
  job.record.identity.seed = scene.compiled.seed;
  job.sample_end = scene.compiled.samples;
  if (run_job(job) == RenderEnd::Interrupted) throw Interrupted();
  const std::string invalid = describe_invalid(job.record, *backend);
  if (!invalid.empty()) std::fprintf(stderr, "warning: %s on %s: %s\n", scene.path.c_str(), scene.device.name().c_str(), invalid.c_str());
  return job.record.film;
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
  bool agree = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& path : o.scenes) {
    SceneOptions scene_options = o.scene_options;
    scene_options.device = "reference";
    const LoadedScene on_reference = load_scene(path, scene_options, {}, {}, false);
    if (on_reference.compiled.samples < 2) throw UsageError("--spp: parity needs at least 2 samples per pixel, to know the noise");
    const Film truth = render_film(on_reference, scene_options);
    for (const std::string& device : devices) {
      scene_options.device = device;
      const LoadedScene on_device = load_scene(path, scene_options, {}, {}, true);
      const ParityResult result = test_parity(estimate_of(render_film(on_device, scene_options)), estimate_of(truth), options);
      agree &= result.agree;
      list.push_back(to_json(path, on_device.device.name(), result));
      if (!o.json) std::printf("%s on %s: %s", path.c_str(), on_device.device.name().c_str(), describe(result).c_str());
      std::fflush(stdout);
    }
  }
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
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_parity(*o); }};
}

}  // namespace stokes
