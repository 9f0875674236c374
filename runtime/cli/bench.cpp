// `stokes bench`: how fast the standard scenes render here, with building kernels apart.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/render_job.h"
#include "cli/scene_options.h"
#include "cli/version.h"
#include "image/error.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

struct BenchOptions {
  std::vector<std::string> scenes;
  std::string suite;
  SceneOptions scene_options;
  int repeat = 3;
  bool json = false;
};

struct BenchCase {
  std::string name, path;
  std::vector<std::string> settings;
  std::optional<int> samples;
};

struct BenchResult {
  std::string name, device, driver;
  double load = 0, build = 0;
  double wall = 0, cpu = 0;  ///< seconds of the repetition of median wall time
  double samples = 0;        ///< pixel samples of one repetition
  RenderCounters counters;   ///< of one repetition
  double efficiency = 0;     ///< pixels / (median relative variance x CPU seconds) / 1e6
};

/// A suite: {"scenes": [{"file": relative to the suite, "name": ..., "spp": n, "set": {"/pointer": value}}, ...]}.
std::vector<BenchCase> read_suite(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be opened");
  try {
    const nlohmann::json suite = nlohmann::json::parse(file);
    std::vector<BenchCase> cases;
    for (const nlohmann::json& entry : suite.at("scenes")) {
      BenchCase c;
      c.path = (fs::path(path).parent_path() / entry.at("file").get<std::string>()).string();
      c.name = entry.value("name", fs::path(c.path).stem().string());
      if (entry.contains("spp")) c.samples = entry.at("spp").get<int>();
      if (entry.contains("set"))
        for (const auto& [pointer, value] : entry.at("set").items()) c.settings.push_back(pointer + "=" + value.dump());
      cases.push_back(c);
    }
    return cases;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(path + ": is no suite: " + e.what());
  }
}

double cpu_seconds() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The median over pixels and R, G, B of a mean's variance over its square; pixels without light are left out.
double median_relative_variance(const Film& film) {
  std::vector<double> values;
  for (int y = 0; y < film.height; y++)
    for (int x = 0; x < film.width; x++)
      for (int c = 0; c < 3; c++) {
        const double mean = film_mean(film, x, y, c);
        if (mean > 0) values.push_back(film_variance(film, x, y, c) / (mean * mean));
      }
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

BenchResult run_case(const BenchCase& c, const BenchOptions& o) {
  SceneOptions scene_options = o.scene_options;
  scene_options.settings.insert(scene_options.settings.begin(), c.settings.begin(), c.settings.end());
  if (!scene_options.samples) scene_options.samples = c.samples;
  const LoadedScene scene = load_scene(c.path, scene_options, {}, {}, true);
  const auto backend = make_backend(scene.compiled, scene.device, {scene_options.threads, scene_options.kernel_dir});
  BenchResult result;
  result.name = c.name;
  result.device = scene.device.name();
  result.driver = scene.device.driver();
  result.load = scene.load_seconds;
  result.build = backend->build_seconds();
  std::vector<std::pair<double, double>> times;
  for (int i = 0; i < o.repeat && !interrupted(); i++) {
    RenderJob job;
    job.backend = backend.get();
    job.record.film = scene.empty_film(scene.whole());
    job.record.identity.seed = scene.compiled.seed;
    job.sample_end = scene.compiled.samples;
    const double cpu_before = cpu_seconds();
    if (run_job(job) == RenderEnd::Interrupted) break;
    times.emplace_back(job.record.render_seconds, cpu_seconds() - cpu_before);
    result.samples = static_cast<double>(film_totals(job.record.film).samples);
    result.counters.rays = job.record.rays;
    result.counters.shadow_rays = job.record.shadow_rays;
    result.counters.scatterings = job.record.scatterings;
    const double pixels = static_cast<double>(job.record.film.width) * job.record.film.height;
    const double variance = median_relative_variance(job.record.film);
    if (variance > 0) result.efficiency = pixels / (variance * times.back().second) * 1e-6;
  }
  if (times.empty()) return result;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  std::tie(result.wall, result.cpu) = times[times.size() / 2];
  return result;
}

nlohmann::ordered_json to_json(const BenchResult& r) {
  const double wall = std::max(1e-9, r.wall), rays = static_cast<double>(r.counters.rays + r.counters.shadow_rays);
  return {{"name", r.name},
          {"device", r.device},
          {"driver", r.driver},
          {"version", program_version()},
          {"load_seconds", r.load},
          {"build_seconds", r.build},
          {"render_seconds", r.wall},
          {"cpu_seconds", r.cpu},
          {"samples", r.samples},
          {"msamples_per_second", r.samples / wall * 1e-6},
          {"msamples_per_cpu_second", r.samples / std::max(1e-9, r.cpu) * 1e-6},
          {"mrays_per_second", rays / wall * 1e-6},
          {"mscatterings_per_second", static_cast<double>(r.counters.scatterings) / wall * 1e-6},
          {"efficiency_median", r.efficiency}};
}

void print_row(const BenchResult& r) {
  const double wall = std::max(1e-9, r.wall), rays = static_cast<double>(r.counters.rays + r.counters.shadow_rays);
  std::printf("%-20s %10.3f %12.3f %10.3f %10.3f %10.3f %9.3f %9.3f\n", r.name.c_str(), r.samples / wall * 1e-6,
              r.samples / std::max(1e-9, r.cpu) * 1e-6, rays / wall * 1e-6, r.efficiency, r.wall, r.build, r.load);
}

int run_bench(const BenchOptions& o) {
  std::vector<BenchCase> cases;
  for (const std::string& path : o.scenes) cases.push_back({fs::path(path).stem().string(), path, {}, {}});
  if (!o.suite.empty() || cases.empty())
    for (const BenchCase& c : read_suite(o.suite.empty() ? "bench/suite.json" : o.suite)) cases.push_back(c);
  catch_interrupts();
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (!o.json)
    std::printf("%-20s %10s %12s %10s %10s %10s %9s %9s\n", "scene", "Msamples/s", "per CPU s", "Mrays/s", "efficiency", "render s", "build s", "load s");
  for (const BenchCase& c : cases) {
    const BenchResult result = run_case(c, o);
    if (interrupted()) return kExitInterrupted;
    list.push_back(to_json(result));
    if (!o.json) print_row(result);
    std::fflush(stdout);
  }
  if (o.json) std::cout << list.dump(2) << "\n";
  return kExitDone;
}

}  // namespace

Command add_bench(CLI::App& root) {
  auto o = std::make_shared<BenchOptions>();
  CLI::App* app = root.add_subcommand("bench", "Renders the standard scenes and prints their speed; the median of the repetitions");
  app->add_option("scenes", o->scenes, "SCENE.json ... [those of the suite]");
  app->add_option("--suite", o->suite, "The suite's file [bench/suite.json, where no scenes are given]");
  app->add_option("--repeat", o->repeat, "Repetitions")->capture_default_str()->check(CLI::Range(1, 1000));
  o->scene_options.add_to(*app);
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_bench(*o); }};
}

}  // namespace stokes
