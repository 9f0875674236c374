// One scene of the benchmark: what is measured, and the measuring. Knows renders and films, not how results are printed.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene_options.h"

namespace stokes {

/// One entry of a suite.
struct BenchCase {
  std::string name, path;
  std::vector<std::string> settings = {};  ///< "/json/pointer=VALUE"
  std::optional<int> samples = {};         ///< per pixel
  std::string size = {};                   ///< "WxH"; empty: the scene's
  std::string parity_size = "24x24";
  int parity_samples = 64;
};

/// What is measured beside speed.
struct BenchParts {
  bool parity = true;  ///< the image against the reference's, at the case's parity size
  bool cold = true;    ///< the kernel build without any cache
  bool noise = true;   ///< variances, from independent parts of a render
  int repeat = 3;      ///< renders timed
};

struct BenchResult {
  std::string name, device, driver;
  int width = 0, height = 0, samples_per_pixel = 0;
  double load = 0, bvh = 0;             ///< seconds; load includes the BVH
  double build_cold = 0, build_warm = 0;///< seconds; cold is 0 where it was not measured
  double wall = 0, cpu = 0;             ///< seconds: medians over the repetitions
  std::vector<double> cpu_runs;
  double samples = 0;                   ///< pixel samples of one repetition
  RenderCounters counters;              ///< of one repetition
  std::array<double, 3> mean{};         ///< R, G, B over the image and all repetitions
  std::uint64_t peak_memory = 0;        ///< bytes, of a process that did nothing else
  /// Pixels / (relative variance x CPU seconds) / 1e6, whatever the samples: of the luminance's median pixel, and of the mean over
  /// pixels (without the noisiest thousandth) of R, G and B. 0: not measured.
  double efficiency_median = 0, efficiency_rgb = 0;
  std::optional<bool> parity;           ///< whether the image is the reference's; unset: not asked
  double parity_z = 0, parity_threshold = 0;
};

/// Reads {"scenes": [{"file": relative to the suite, "name": ..., "spp": n, "size": "WxH", "set": {"/pointer": value},
/// "parity": {"size": "WxH", "spp": n}}, ...]}. Throws InputError.
std::vector<BenchCase> read_suite(const std::string& path);

/// Renders and measures one case in this process. Returns nothing when interrupted. Throws what loading and rendering throw.
std::optional<BenchResult> run_case(const BenchCase& bench_case, const SceneOptions& options, const BenchParts& parts);

}  // namespace stokes
