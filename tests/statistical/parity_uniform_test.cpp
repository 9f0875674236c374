// The parity test against itself: over many seeds the p-values of the images' means must be uniform, or it calls equal renderers different too
// often, or too rarely to notice unequal ones. Those of the worst block may only be too large: Sidak's correction takes all tests for
// independent, which a pixel's channels are not, and a block's variance is at least its neighbourhood's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "image/parity.h"
#include "scene/read_scene.h"
#include "support/backends.h"

namespace stokes::tests {
namespace {

constexpr int kSeeds = 60, kSize = 24;
// Three scenes of four channels and one worst block each: one in a hundred runs of an exact test would fail.
constexpr double kThreshold = 0.01 / 15;

/// Kolmogorov's tail for the largest distance d of n uniform numbers' distribution function from the diagonal (Stephens' correction for small n).
double kolmogorov_tail(double d, int n) {
  const double root = std::sqrt(double(n)), x = d * (root + 0.12 + 0.11 / root);
  if (x < 0.2) return 1;  // where the series converges slowly
  double sum = 0;
  for (int k = 1; k <= 100; k++) sum += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

struct Distances {
  double above = 0;  ///< of the empirical distribution function above the diagonal: p-values that are too small
  double below = 0;
};

Distances distances_from_uniform(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  Distances d;
  const double n = double(p.size());
  for (std::size_t i = 0; i < p.size(); i++) {
    d.above = std::max(d.above, double(i + 1) / n - p[i]);
    d.below = std::max(d.below, p[i] - double(i) / n);
  }
  return d;
}

void expect_uniform(const std::string& what, const std::vector<double>& p, bool may_be_large) {
  const Distances distances = distances_from_uniform(p);
  const double d = may_be_large ? distances.above : std::max(distances.above, distances.below);
  // One side's tail is half of both sides'.
  const double tail = kolmogorov_tail(d, int(p.size())) / (may_be_large ? 2 : 1);
  std::printf("%s: Kolmogorov-Smirnov distance %.3f over %zu seeds, p %.4f, threshold %.4f\n", what.c_str(), d, p.size(), tail, kThreshold);
  EXPECT_GT(tail, kThreshold) << what;
}

class ParityUniform : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(ParityUniform, OverSeeds) {
  const auto [name, samples] = GetParam();
  SceneDescription scene = read_scene((std::filesystem::path(STOKES_SOURCE_DIR) / "scenes" / (std::string(name) + ".json")).string());
  scene.camera.width = scene.camera.height_pixels = kSize;
  const CompiledScene compiled = compile_scene(scene);
  std::vector<double> worst;
  std::map<std::string, std::vector<double>> means;
  for (int i = 0; i < kSeeds; i++) {
    const std::string seed = name + std::to_string(i);
    const ParityResult result = test_parity(estimate_of(render_by_opencl(compiled, samples, seed_of("opencl " + seed))),
                                            estimate_of(render_by_reference(compiled, samples, seed_of("reference " + seed))));
    worst.push_back(result.p);
    for (const ParityTest& mean : result.means)
      if (mean.sigma > 0) means[mean.channel].push_back(mean.p);
  }
  for (const auto& [channel, p] : means) expect_uniform(std::string(name) + ", mean of " + channel, p, false);
  expect_uniform(std::string(name) + ", worst block", worst, true);
}

INSTANTIATE_TEST_SUITE_P(Scene, ParityUniform, testing::Values(std::pair("jensen_box", 64), std::pair("fog_box", 64), std::pair("fluorescent_box", 64)),
                         [](const auto& info) { return std::string(info.param.first); });

}  // namespace
}  // namespace stokes::tests
