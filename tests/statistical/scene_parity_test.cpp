// Every scene that is shipped, tiny: the OpenCL renderer against the CPU reference. All scenes together reject equal renderers with
// probability 1 %. Knows nothing of what the scenes hold; a new file in scenes/ is tested without a change here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "image/parity.h"
#include "scene/read_scene.h"
#include "support/backends.h"

namespace stokes::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kAlpha = 0.01;
constexpr int kLongEdge = 48;
// Pixel samples a scene by default, and of those whose every sample is dear.
constexpr int kSamples = 64;
constexpr std::pair<const char*, int> kOtherSamples[] = {
    {"hand", 16}, {"head_ior", 8}, {"head_offset_scaling", 8}, {"head_one_layer", 8}, {"head_vsss", 8}, {"head_vvss", 8}, {"head_vvvv", 4},
    {"skin_chart", 8}, {"skin_one_layer", 8}, {"skin_two_layers", 8}};

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(STOKES_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

int samples_of(const std::string& name) {
  for (const auto& [scene, samples] : kOtherSamples)
    if (name == scene) return samples;
  return kSamples;
}

class SceneParity : public testing::TestWithParam<std::string> {};

TEST_P(SceneParity, Agrees) {
  const std::string name = GetParam();
  SceneDescription scene = read_scene((fs::path(STOKES_SOURCE_DIR) / "scenes" / (name + ".json")).string());
  CameraDescription& camera = scene.camera;
  const double scale = double(kLongEdge) / std::max(camera.width, camera.height_pixels);
  camera.width = std::max(8, int(std::lround(camera.width * scale)));
  camera.height_pixels = std::max(8, int(std::lround(camera.height_pixels * scale)));
  const CompiledScene compiled = compile_scene(scene);

  const int samples = samples_of(name);
  const Film device = render_by_opencl(compiled, samples, seed_of("opencl " + name));
  const Film truth = render_by_reference(compiled, samples, seed_of("reference " + name));
  ParityOptions options;
  options.alpha = -std::expm1(std::log1p(-kAlpha) / double(shipped_scenes().size()));
  const ParityResult result = test_parity(estimate_of(device), estimate_of(truth), options);
  std::printf("%s", describe(result).c_str());
  EXPECT_TRUE(result.agree) << name << ": " << describe(result);
  // Both must have seen something; saturated colours may be negative.
  for (const ParityTest& mean : result.means)
    if (mean.channel == "G") {
      EXPECT_NE(mean.mean_b, 0) << name << " is black";
    }
}

INSTANTIATE_TEST_SUITE_P(Scene, SceneParity, testing::ValuesIn(shipped_scenes()), [](const auto& info) { return info.param; });

}  // namespace
}  // namespace stokes::tests
