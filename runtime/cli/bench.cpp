// `stokes bench`: how fast the standard scenes render here, with building kernels apart. A process for each scene, so that caches and
// peak memory are its own. Knows how results are gathered and printed, not how they are measured.
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/bench_case.h"
#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/version.h"
#include "image/error.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct BenchOptions {
  std::vector<std::string> scenes;
  std::string suite;
  SceneOptions scene_options;
  BenchParts parts;
  bool json = false;
};

/// The suite that comes with the program: of the working folder, else beside the program or its build folder, else of the sources.
std::string default_suite() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& path : {fs::path("bench/suite.json"), program / "bench/suite.json", program / "../bench/suite.json", fs::path(STOKES_BENCH_SUITE)})
    if (fs::exists(path, ignored)) return path.string();
  throw UsageError("--suite: there is no bench/suite.json here or beside the program; name a suite or scenes");
}

ordered_json to_json(const BenchResult& r) {
  const double cpu = std::max(1e-9, r.cpu), wall = std::max(1e-9, r.wall);
  const auto rate = [&](std::uint64_t count) { return static_cast<double>(count) / wall * 1e-6; };
  ordered_json j = {{"name", r.name},
                    {"device", r.device},
                    {"driver", r.driver},
                    {"version", program_version()},
                    {"width", r.width},
                    {"height", r.height},
                    {"samples_per_pixel", r.samples_per_pixel},
                    {"load_seconds", r.load},
                    {"bvh_seconds", r.bvh},
                    {"build_cold_seconds", r.build_cold},
                    {"build_warm_seconds", r.build_warm},
                    {"render_seconds", r.wall},
                    {"cpu_seconds", r.cpu},
                    {"cpu_seconds_runs", r.cpu_runs},
                    {"samples", r.samples},
                    {"rays", r.counters.rays},
                    {"shadow_rays", r.counters.shadow_rays},
                    {"scatterings", r.counters.scatterings},
                    {"invalid_samples", r.counters.invalid},
                    {"msamples_per_second", r.samples / wall * 1e-6},
                    {"msamples_per_cpu_second", r.samples / cpu * 1e-6},
                    {"mrays_per_second", rate(r.counters.rays)},
                    {"mshadow_rays_per_second", rate(r.counters.shadow_rays)},
                    {"mscatterings_per_second", rate(r.counters.scatterings)},
                    {"mscatterings_per_cpu_second", static_cast<double>(r.counters.scatterings) / cpu * 1e-6},
                    {"efficiency_median", r.efficiency_median},
                    {"efficiency_rgb", r.efficiency_rgb},
                    {"mean", r.mean},
                    {"peak_memory_bytes", r.peak_memory}};
  if (r.parity) j["parity"] = {{"agree", *r.parity}, {"largest_z", r.parity_z}, {"threshold_z", r.parity_threshold}};
  return j;
}

void print_header() {
  std::printf("%-16s %10s %10s %8s %8s %8s %8s %8s %7s %7s %7s %6s %s\n", "scene", "Msamples/s", "per CPU s", "Mrays/s", "Mshad/s", "Mscat/s",
              "eff_med", "eff_rgb", "cold s", "warm s", "BVH s", "MiB", "parity");
}

void print_row(const ordered_json& j) {
  const auto n = [&](const char* key) { return j.at(key).get<double>(); };
  const char* parity = !j.contains("parity") ? "not asked" : j["parity"]["agree"] ? "passed" : "FAILED: no score";
  const bool scores = !j.contains("parity") || j["parity"]["agree"].get<bool>();
  std::printf("%-16s %10.3f %10.3f %8.3f %8.3f %8.3f %8.3f %8.3f %7.2f %7.2f %7.2f %6.0f %s\n", j.at("name").get<std::string>().c_str(),
              scores ? n("msamples_per_second") : 0.0, scores ? n("msamples_per_cpu_second") : 0.0, n("mrays_per_second"), n("mshadow_rays_per_second"),
              n("mscatterings_per_second"), n("efficiency_median"), n("efficiency_rgb"), n("build_cold_seconds"), n("build_warm_seconds"),
              n("bvh_seconds"), n("peak_memory_bytes") / (1024.0 * 1024.0), parity);
}

/// A new folder for the caches of one scene's process, so that its first build is a cold one; gone with this object.
class EmptyCaches {
 public:
  EmptyCaches() {
    std::string name = (fs::temp_directory_path() / "stokes-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw OutputError("no temporary folder can be made");
    folder_ = name;
  }
  ~EmptyCaches() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  EmptyCaches(const EmptyCaches&) = delete;
  void use() const {
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    setenv("POCL_CACHE_DIR", (folder_ + "/pocl").c_str(), 1);
  }

 private:
  std::string folder_;
};

/// In a process of its own: measures, writes the result to `pipe`, and ends. Errors go the way of the program's other errors.
[[noreturn]] void run_child(const BenchCase& c, const BenchOptions& o, int pipe) {
  // Threads do not outlive fork(): at an ordinary exit, after an error, the destructors of libraries would wait for theirs for ever.
  on_exit([](int status, void*) { std::fflush(nullptr), std::_Exit(status); }, nullptr);
  const auto result = run_case(c, o.scene_options, o.parts);
  if (!result) std::_Exit(kExitInterrupted);
  const std::string text = to_json(*result).dump();
  const bool written = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  std::fflush(nullptr);
  std::_Exit(written ? kExitDone : kExitInternal);
}

/// The result of a case, or the exit code of the process that failed.
std::pair<ordered_json, int> run_apart(const BenchCase& c, const BenchOptions& o) {
  const EmptyCaches caches;
  int ends[2];
  if (pipe(ends) != 0) throw OutputError("no pipe can be made");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw OutOfMemory("no process can be made for " + c.name);
  if (child == 0) {
    close(ends[0]);
    if (o.parts.cold) caches.use();
    run_child(c, o, ends[1]);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) != 0;) {
    if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
    if (n < 0 && errno != EINTR) break;
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status)) std::fprintf(stderr, "error: %s: the process that rendered it was ended by signal %d\n", c.name.c_str(), WTERMSIG(status));
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : kExitInternal;
  return {code == kExitDone ? ordered_json::parse(text) : ordered_json(), code};
}

int run_bench(const BenchOptions& o) {
  std::vector<BenchCase> cases;
  for (const std::string& path : o.scenes) cases.push_back({.name = fs::path(path).stem().string(), .path = path});
  if (!o.suite.empty() || cases.empty())
    for (const BenchCase& c : read_suite(o.suite.empty() ? default_suite() : o.suite)) cases.push_back(c);
  catch_interrupts();
  ordered_json list = ordered_json::array();
  bool agree = true;
  if (!o.json) print_header();
  for (const BenchCase& c : cases) {
    const auto [result, code] = run_apart(c, o);
    if (code != kExitDone) return code;
    agree &= !result.contains("parity") || result["parity"]["agree"].get<bool>();
    if (!o.json) print_row(result);
    std::fflush(stdout);
    list.push_back(result);
  }
  if (o.json) std::cout << list.dump(2) << "\n";
  return agree ? kExitDone : kExitDifferent;
}

}  // namespace

Command add_bench(CLI::App& root) {
  auto o = std::make_shared<BenchOptions>();
  CLI::App* app = root.add_subcommand("bench", "Renders the standard scenes and prints their speed; a score counts only where the image is the reference's (exit code 7 if not)");
  app->add_option("scenes", o->scenes, "SCENE.json ... [those of the suite]");
  app->add_option("--suite", o->suite, "The suite's file [bench/suite.json, here or beside the program, where no scenes are given]");
  app->add_option("--repeat", o->parts.repeat, "Renders timed; the median counts")->capture_default_str()->check(CLI::Range(1, 1000));
  app->add_flag("!--no-parity", o->parts.parity, "Do not compare with the reference");
  app->add_flag("!--no-cold", o->parts.cold, "Do not measure a kernel build without caches");
  app->add_flag("!--no-noise", o->parts.noise, "Do not measure variances");
  o->scene_options.add_to(*app);
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_bench(*o); }};
}

}  // namespace stokes
