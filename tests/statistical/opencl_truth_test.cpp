// The OpenCL renderer against closed forms and published figures: every case with 4 wavelengths a path, spectral ones of all kinds also with
// 1 and 8. The scenes are in tests/support/truth_*.cpp; nothing here knows the CPU reference.
#include <gtest/gtest.h>

#include "support/backends.h"
#include "support/truth_scenes.h"

namespace stokes::tests {
namespace {

class OpenClTruth : public testing::TestWithParam<TruthCase> {};

TEST_P(OpenClTruth, Agrees) { check_truth_case(GetParam(), opencl_backend, seed_of("opencl " + GetParam().name)); }

/// The named cases with another number of wavelengths a path.
std::vector<TruthCase> with_wavelengths(int count, const std::vector<std::string>& names) {
  std::vector<TruthCase> cases;
  for (const auto& all : {furnace_cases(), irradiance_cases(), boundary_cases(), slab_cases(), chromatic_cases(), fluorescence_cases()})
    for (TruthCase c : all) {
      if (std::find(names.begin(), names.end(), c.name) == names.end()) continue;
      c.scene.integrator.wavelengths_per_path = count;
      c.name += "_by_" + std::to_string(count);
      // Fewer wavelengths a path are noisier, more are dearer.
      if (count < 4) c.samples *= 4;
      if (count > 4) c.samples /= 2;
      cases.push_back(std::move(c));
    }
  if (cases.size() != names.size()) throw std::logic_error("a truth case of opencl_truth_test.cpp no longer exists");
  return cases;
}

const std::vector<std::string> kAtOtherCounts = {"white_furnace_sphere_mis_spectral",
                                                 "chromatic_half_space",
                                                 "chromatic_slab_T",
                                                 "dispersive_sheet",
                                                 "colored_furnace_spectral",
                                                 "fluorescent_patch_2_mis",
                                                 "fluorescent_patch_2_mats",
                                                 "fluorescent_patch_stokes_mis",
                                                 "measured_patch_mis",
                                                 "fluorescent_plates_r5_B_mis",
                                                 "fluorescent_cavity_mis",
                                                 "fluorescent_cavity_mats",
                                                 "dyed_slab_absorbing_45_mis"};

std::string case_name(const testing::TestParamInfo<TruthCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Furnace, OpenClTruth, testing::ValuesIn(furnace_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Irradiance, OpenClTruth, testing::ValuesIn(irradiance_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Boundary, OpenClTruth, testing::ValuesIn(boundary_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Slab, OpenClTruth, testing::ValuesIn(slab_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Chromatic, OpenClTruth, testing::ValuesIn(chromatic_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Airlight, OpenClTruth, testing::ValuesIn(airlight_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Fluorescence, OpenClTruth, testing::ValuesIn(fluorescence_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(OneWavelength, OpenClTruth, testing::ValuesIn(with_wavelengths(1, kAtOtherCounts)), case_name);
INSTANTIATE_TEST_SUITE_P(EightWavelengths, OpenClTruth, testing::ValuesIn(with_wavelengths(8, kAtOtherCounts)), case_name);

}  // namespace
}  // namespace stokes::tests
