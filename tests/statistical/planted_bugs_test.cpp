// Would the checks notice? Each bug of planted_bugs.h is planted in a copy of the kernels, which then must fail a check that the true kernels
// pass with the same seed. A check is a truth case, or a small scene whose render must agree with the reference's.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "device/kernel_files.h"
#include "image/parity.h"
#include "planted_bugs.h"
#include "planted_scenes.h"
#include "support/backends.h"

namespace stokes::tests {
namespace {

namespace fs = std::filesystem;

// A two-sided normal deviation beyond this has a probability of 7e-6.
constexpr double kNoticed = 4.5, kTableAccuracy = 1e-4, kParityAlpha = 1e-5;

/// The kernels of this binary in a folder, one text replaced; deleted in the end.
class MutatedKernels {
 public:
  explicit MutatedKernels(const PlantedBug& bug) : folder_(fs::temp_directory_path() / ("stokes_planted_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
    KernelFiles files = embedded_kernels();
    std::string& text = files.at(bug.file);
    const std::size_t at = text.find(bug.find);
    if (at == std::string::npos || text.find(bug.find, at + 1) != std::string::npos)
      throw std::runtime_error(std::string(bug.file) + " must hold this text exactly once: " + bug.find);
    text.replace(at, std::string(bug.find).size(), bug.replacement);
    for (const auto& [file, contents] : files) std::ofstream(folder_ / file, std::ios::binary) << contents;
  }
  ~MutatedKernels() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_;
};

/// The largest deviation that a truth case shows, in standard errors beyond the table's own accuracy.
double deviation_from_truth(const TruthCase& c, const std::string& kernel_dir) {
  const auto backend = [&](const CompiledScene& scene, int spp, std::uint32_t seed) { return develop(render_by_opencl(scene, spp, seed, kernel_dir), false); };
  double largest = 0;
  for (const TruthResult& r : run_truth_case(c, backend, seed_of("planted " + c.name))) {
    const double error = std::max(0.0, std::abs(r.mean - r.expected) - kTableAccuracy * std::abs(r.expected));
    const double z = error > 0 ? error / std::max(r.standard_error, 1e-12) : 0;
    std::printf("  %s: expected %.6g, got %.6g +- %.2g\n", r.label.c_str(), r.expected, r.mean, r.standard_error);
    largest = std::max(largest, z);
  }
  return largest;
}

/// A result in multiples of its limit: above 1 the check has noticed something.
double run_check(const std::string& name, const std::string& kernel_dir) {
  if (const auto scenes = parity_scenes(); scenes.contains(name)) {
    const ParityScene& s = scenes.at(name);
    const CompiledScene compiled = compile_scene(s.scene);
    static std::map<std::string, Film> references;
    if (!references.contains(name)) references.emplace(name, render_by_reference(compiled, s.samples, seed_of("reference " + name)));
    const Film film = render_by_opencl(compiled, s.samples, seed_of("planted " + name), kernel_dir);
    const ParityResult r = test_parity(estimate_of(film), estimate_of(references.at(name)), {kParityAlpha});
    std::printf("%s", describe(r).c_str());
    return std::abs(r.worst.z) / r.threshold;
  }
  for (const auto& all : {furnace_cases(), boundary_cases(), slab_cases(), chromatic_cases(), airlight_cases(), fluorescence_cases()})
    for (const TruthCase& c : all)
      if (c.name == name) return deviation_from_truth(c, kernel_dir) / kNoticed;
  throw std::runtime_error("no such check: " + name);
}

std::vector<std::string> checks_in_use() {
  std::set<std::string> names;
  for (const PlantedBug& b : kPlantedBugs) names.insert(b.check);
  return {names.begin(), names.end()};
}

class TrueKernels : public testing::TestWithParam<std::string> {};
TEST_P(TrueKernels, Pass) { EXPECT_LT(run_check(GetParam(), ""), 1); }
INSTANTIATE_TEST_SUITE_P(Check, TrueKernels, testing::ValuesIn(checks_in_use()), [](const auto& info) { return info.param; });

class PlantedBugs : public testing::TestWithParam<PlantedBug> {};
TEST_P(PlantedBugs, AreNoticed) {
  const MutatedKernels kernels(GetParam());
  bool noticed = false;
  try {
    noticed = run_check(GetParam().check, kernels.folder()) > 1;
  } catch (const InvalidSamples& e) {
    std::printf("  %s\n", e.what());
    noticed = true;
  }
  EXPECT_TRUE(noticed) << GetParam().name << " goes unnoticed by " << GetParam().check;
}
INSTANTIATE_TEST_SUITE_P(Bug, PlantedBugs, testing::ValuesIn(kPlantedBugs), [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace stokes::tests
