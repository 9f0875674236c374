// OpenCL renders against golden images: means and variances that the CPU reference has made once (make.sh). They notice when both
// integrators drift together. A file that is missing fails.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "image/image_file.h"
#include "image/parity.h"
#include "scene/read_scene.h"
#include "support/backends.h"

namespace stokes::tests {
namespace {

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, OpenClAgrees) {
  const std::filesystem::path source = STOKES_SOURCE_DIR;
  const Image golden = read_image((source / "tests/golden" / (GetParam() + ".exr")).string());
  SceneDescription scene = read_scene((source / "scenes" / (GetParam() + ".json")).string());
  scene.camera.width = golden.width;
  scene.camera.height_pixels = golden.height;
  const Film film = render_by_opencl(compile_scene(scene), 64, seed_of("golden " + GetParam()));
  ParityOptions options;
  options.alpha = 1e-3;
  options.block = 8;
  const ParityResult result = test_parity(estimate_of(develop(film, true)), estimate_of(golden), options);
  std::printf("%s", describe(result).c_str());
  EXPECT_TRUE(result.agree) << describe(result);
}

INSTANTIATE_TEST_SUITE_P(Scene, Golden, testing::Values("jensen_box", "fog_box", "fluorescent_box", "dispersion_sphere"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace stokes::tests
