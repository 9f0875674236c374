// The parts of the device side that need no device: choice among devices, assembly, cache, launch plan.
#include <gmock/gmock.h>

#include "device/binary_cache.h"
#include "device/build_constants.h"
#include "device/error.h"
#include "device/launch_plan.h"
#include "unit/device_kernel.h"

namespace stokes {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

DeviceInfo fake(int platform, int device, const std::string& platform_name, const std::string& name, const std::string& type, std::uint64_t gib) {
  DeviceInfo info;
  info.platform = platform;
  info.device = device;
  info.platform_name = platform_name;
  info.name = name;
  info.type = type;
  info.memory_bytes = gib << 30;
  return info;
}

std::vector<DeviceInfo> fakes() {
  return {fake(0, 0, "rusticl", "llvmpipe", "cpu", 8), fake(1, 0, "Portable Computing Language", "pthread-EPYC", "cpu", 8),
          fake(3, 0, "Acme", "Small GPU", "gpu", 1), fake(3, 1, "Acme", "Large GPU", "gpu", 80), fake(4, 0, "Zeta", "Card", "accelerator", 16)};
}

std::string message_of(const std::vector<DeviceInfo>& devices, const std::string& spec) {
  try {
    choose_among(devices, spec);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ChooseDevice, AutoTakesTheFirstGpuWithEnoughMemory) {
  EXPECT_EQ(choose_among(fakes(), "auto", 0).name, "Small GPU");
  EXPECT_EQ(choose_among(fakes(), "auto", 2ull << 30).name, "Large GPU");
}

TEST(ChooseDevice, AutoFallsBackToAcceleratorThenCpu) {
  std::vector<DeviceInfo> devices = fakes();
  devices[3].usable = false;
  EXPECT_EQ(choose_among(devices, "auto", 2ull << 30).name, "Card");
  devices.erase(devices.begin() + 2, devices.end());
  EXPECT_EQ(choose_among(devices, "auto").name, "pthread-EPYC");  // not rusticl, which comes first
  devices.erase(devices.begin() + 1);
  EXPECT_EQ(choose_among(devices, "auto").name, "llvmpipe");
}

TEST(ChooseDevice, ByNumberTypeAndPartOfAName) {
  EXPECT_EQ(choose_among(fakes(), "3:1").name, "Large GPU");
  EXPECT_EQ(choose_among(fakes(), "cpu").name, "pthread-EPYC");
  EXPECT_EQ(choose_among(fakes(), "PORTABLE").name, "pthread-EPYC");
  EXPECT_EQ(choose_among(fakes(), "large").name, "Large GPU");
}

TEST(ChooseDevice, ErrorsListWhatThereIs) {
  EXPECT_THAT(message_of(fakes(), "acme"), testing::AllOf(HasSubstr("several"), HasSubstr("Small GPU"), HasSubstr("Large GPU"),
                                                         testing::Not(HasSubstr("llvmpipe"))));
  EXPECT_THAT(message_of(fakes(), "nonesuch"), HasSubstr("llvmpipe"));
  EXPECT_THAT(message_of(fakes(), "2:0"), HasSubstr("no device 2:0"));
  EXPECT_THAT(message_of({}, "auto"), HasSubstr("no OpenCL device was found"));
  std::vector<DeviceInfo> devices = fakes();
  devices[0].usable = false;
  devices[0].why_not = "it is on fire";
  EXPECT_THAT(message_of(devices, "0:0"), HasSubstr("it is on fire"));
}

TEST(AssembleProgram, IncludesEachFileOnceAndNamesPlaces) {
  const KernelFiles files = {{"a.h", "A\n"}, {"b.cl", "#include \"a.h\"\nB\n"}, {"root.cl", "one\n#include \"a.h\"\n  # include \"b.cl\"\nfour\n"}};
  EXPECT_EQ(assemble_program(files, "root.cl", "#define X 1\n"),
            "#line 1 \"build constants\"\n#define X 1\n"
            "#line 1 \"root.cl\"\none\n"
            "#line 1 \"a.h\"\nA\n"
            "#line 3 \"root.cl\"\n"
            "#line 1 \"b.cl\"\n\nB\n"
            "#line 4 \"root.cl\"\nfour\n");
}

TEST(AssembleProgram, AMissingFileIsReportedWithItsPlace) {
  const KernelFiles files = {{"root.cl", "one\n#include \"gone.cl\"\n"}};
  try {
    assemble_program(files, "root.cl", "");
    FAIL() << "no error";
  } catch (const KernelBuildError& error) {
    EXPECT_THAT(error.what(), HasSubstr("root.cl:2: error: there is no kernel file \"gone.cl\""));
  }
}

TEST(KernelFiles, TheEmbeddedOnesAreThoseOfTheFolder) {
  EXPECT_EQ(read_kernel_dir(STOKES_SOURCE_DIR "/kernels"), embedded_kernels());
  EXPECT_THROW(read_kernel_dir("/nonexistent"), DeviceError);
}

TEST(BuildConstants, FollowTheScene) {
  CompiledScene scene{};
  scene.features.reradiation = true;
  scene.wavelengths_per_path = 8;
  scene.header.spectral_bins = 3;
  const std::string text = build_constants(scene, {16, true});
  for (const char* line : {"LANES 16\n", "STOKES_X86 1\n", "WAVELENGTHS 8\n", "BVH_WIDTH 8\n", "FILM_SPECTRAL 1\n", "SCENE_HAS_RERADIATION 1\n",
                           "SCENE_HAS_LENS 0\n", "SCENE_RGB 0\n"})
    EXPECT_THAT(text, HasSubstr(std::string("#define ") + line));
}

TEST(BinaryCache, ReturnsWhatWasStored) {
  const TemporaryFolder folder;
  const std::string place = folder.path / "deep" / "cache", bytes("a\0b", 3);
  EXPECT_EQ(read_cached(place, "key"), "");
  write_cached(place, "key", bytes);
  EXPECT_EQ(read_cached(place, "key"), bytes);
  EXPECT_EQ(read_cached(place, "other key"), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(place), {}), 1) << "something was left beside the entry";
}

TEST(BinaryCache, ADamagedFileIsAsGoodAsNone) {
  const TemporaryFolder folder;
  const std::string file = cache_file(folder.path, "key");
  write_cached(folder.path, "key", std::string(1000, 'x'));
  const auto size = std::filesystem::file_size(file);
  // Every byte matters, in the header and after it.
  for (std::size_t at = 0; at < size; at += 7) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(at));
    const char old = static_cast<char>(stream.get());
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(old ^ 4)).flush();
    EXPECT_EQ(read_cached(folder.path, "key"), "") << "byte " << at;
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(old);
  }
  EXPECT_NE(read_cached(folder.path, "key"), "");
  std::filesystem::resize_file(file, size - 1);
  EXPECT_EQ(read_cached(folder.path, "key"), "");
  std::filesystem::resize_file(file, 0);
  EXPECT_EQ(read_cached(folder.path, "key"), "");
}

TEST(BinaryCache, NeverFailsAndDoesNotGrowForever) {
  write_cached("/proc/nonexistent", "key", "bytes");
  write_cached("", "key", "bytes");
  EXPECT_EQ(read_cached("", "key"), "");
  const TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) write_cached(folder.path, std::to_string(i), "bytes");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 64);
  EXPECT_EQ(read_cached(folder.path, "99"), "bytes");
}

// Runs a plan on a machine of a given speed and checks that every sample of every pixel comes exactly once, whole passes in order.
struct Rehearsal {
  int launches = 0;
  double longest = 0;
};

Rehearsal rehearse(std::uint32_t pixels, std::uint32_t begin, std::uint32_t end, double paths_per_second, std::uint64_t most_paths = 1u << 30) {
  Rehearsal result;
  std::vector<std::uint32_t> next(pixels, begin);
  LaunchPlan plan(pixels, begin, end, 512, most_paths, 0.05);
  while (!plan.done()) {
    const LaunchPlan::Range range = plan.next();
    EXPECT_LT(range.pixel_begin, range.pixel_end);
    EXPECT_LT(range.sample_begin, range.sample_end);
    EXPECT_LE(range.paths(), most_paths + most_paths / 4);
    for (std::uint32_t p = range.pixel_begin; p < range.pixel_end; ++p) {
      EXPECT_EQ(next[p], range.sample_begin);
      next[p] = range.sample_end;
    }
    const double seconds = range.paths() / paths_per_second;
    plan.complete(range, seconds);
    result.longest = std::max(result.longest, seconds);
    ++result.launches;
    if (plan.between_passes()) { EXPECT_THAT(next, testing::Each(plan.whole_passes_end())); }
  }
  EXPECT_THAT(next, testing::Each(end));
  return result;
}

TEST(LaunchPlan, CoversEverySampleOnceAtAnySpeed) {
  for (const std::uint32_t pixels : {1u, 7u, 511u, 512u, 513u, 20000u})
    for (const double speed : {1e3, 1e5, 1e9}) rehearse(pixels, 3, 20, speed);
}

TEST(LaunchPlan, KeepsBelowTheMostPaths) {
  for (const std::uint32_t pixels : {1u, 40u, 1000u}) rehearse(pixels, 3, 20, 1e6, 100);
}

TEST(LaunchPlan, LaunchesTakeAboutTheTargetTime) {
  for (const double speed : {2e4, 1e6, 1e7}) {
    const Rehearsal result = rehearse(30000, 0, 64, speed);
    EXPECT_LT(result.longest, 0.076) << speed;
    EXPECT_LT(result.launches, 30000 * 64 / speed / 0.05 * 1.5 + 12) << speed;
  }
}

}  // namespace
}  // namespace stokes
