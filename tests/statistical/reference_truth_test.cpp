// The reference against closed forms and published figures; the scenes are in tests/support/truth_*.cpp.
#include <gtest/gtest.h>

#include <thread>

#include "reference/reference.h"
#include "support/truth_scenes.h"

namespace stokes::tests {
namespace {

/// A fixed seed of its own for every case (FNV-1a of its name), so that the cases' errors are independent.
std::uint32_t seed_of(const std::string& name) {
  std::uint32_t h = 2166136261u;
  for (const char c : name) h = (h ^ std::uint32_t(static_cast<unsigned char>(c))) * 16777619u;
  return h;
}

Image reference_backend(const CompiledScene& scene, int spp, std::uint32_t seed) {
  const layout::Scene& h = scene.header;
  const int width = int(h.camera.width), height = int(h.camera.height);
  Film film = make_film(width, height, 0, 0, width, height, h.film_channels, int(h.spectral_bins), h.spectral_begin, h.spectral_end, h.film_quantum,
                        h.depth_quantum);
  reference::render_samples(scene, film, seed, 0, spp, int(std::max(1u, std::thread::hardware_concurrency())), nullptr);
  return develop(film, false);
}

class ReferenceTruth : public testing::TestWithParam<TruthCase> {};

TEST_P(ReferenceTruth, Agrees) { check_truth_case(GetParam(), reference_backend, seed_of(GetParam().name)); }

std::string case_name(const testing::TestParamInfo<TruthCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Furnace, ReferenceTruth, testing::ValuesIn(furnace_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Irradiance, ReferenceTruth, testing::ValuesIn(irradiance_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Boundary, ReferenceTruth, testing::ValuesIn(boundary_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Slab, ReferenceTruth, testing::ValuesIn(slab_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Chromatic, ReferenceTruth, testing::ValuesIn(chromatic_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Airlight, ReferenceTruth, testing::ValuesIn(airlight_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Fluorescence, ReferenceTruth, testing::ValuesIn(fluorescence_cases()), case_name);

}  // namespace
}  // namespace stokes::tests
