// The machinery around the kernels, on every OpenCL device of this machine and with a stand-in for the render kernel.
#include <gmock/gmock.h>

#include <ctime>

#include "device/binary_cache.h"
#include "device/device_list.h"
#include "device/error.h"
#include "device/layout_check.h"
#include "device/program.h"
#include "device/scene_buffers.h"
#include "unit/device_kernel.h"

namespace stokes {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

// STOKES_DEVICE chooses another device than the first CPU, so that one test binary serves every runtime.
DeviceInfo test_device() {
  const char* spec = std::getenv("STOKES_DEVICE");
  return choose_device(spec ? spec : "auto");
}

// Seconds of the whole process per core of the device: unlike the clock's, they do not depend on what else the machine does.
double cpu_seconds() {
  static const double cores = test_device().compute_units;
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC / cores;
}

Film film_of(int width, int height, int crop_x = 0) { return make_film(64, 64, crop_x, 0, width, height, 0, 0, 0, 0, 1, 1); }

// What the stand-in kernel sums.
Film expected_film(int width, int height, int crop_x, std::uint32_t seed, int begin, int end) {
  Film film = film_of(width, height, crop_x);
  for (int p = 0; p < width * height; ++p) {
    std::int64_t* words = &film.words[static_cast<std::size_t>(p) * film.stride];
    for (int s = begin; s < end; ++s) {
      const std::uint64_t x = test::stand_in_value(seed, p, s), before = static_cast<std::uint64_t>(words[3]);
      words[0] += static_cast<std::int64_t>(x);
      words[3] = static_cast<std::int64_t>(before + x * x);
      words[4] += before + x * x < before;
      words[9] += crop_x + p % width;
      words[10] += 1;
    }
  }
  return film;
}

class DeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
    setenv("XDG_CACHE_HOME", cache_.path.c_str(), 1);
    test::write_kernel_dir(kernels_);
    options_.kernel_dir = kernels_.path;
  }
  std::vector<std::filesystem::path> cached_files() const {
    std::vector<std::filesystem::path> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(cache_folder(), none)) files.push_back(entry.path());
    return files;
  }
  TemporaryFolder cache_, kernels_;
  DeviceOptions options_;
};

TEST_F(DeviceTest, EveryDeviceIsDescribed) {
  for (const DeviceInfo& device : list_devices()) {
    EXPECT_FALSE(device.platform_name.empty());
    EXPECT_FALSE(device.name.empty());
    EXPECT_THAT(device.type, testing::AnyOf("cpu", "gpu", "accelerator"));
    EXPECT_GT(device.compute_units, 0u);
    EXPECT_GT(device.memory_bytes, 0u);
    const std::string numbers = std::to_string(device.platform) + ":" + std::to_string(device.device);
    if (device.usable) { EXPECT_EQ(choose_device(numbers).name, device.name); }
  }
}

TEST_F(DeviceTest, SceneArraysAreInTheOrderOfTheView) {
  std::vector<std::string> uploaded, viewed;
  const CompiledScene scene = test::empty_scene();
  for (const SceneArray& array : list_scene_arrays(scene)) uploaded.push_back(array.name);
  for (const test::ViewMember& member : test::view_members()) viewed.push_back(member.name);
  EXPECT_EQ(uploaded, viewed);
}

TEST_F(DeviceTest, TheLayoutIsTheHostsAndAPlantedDifferenceIsFound) {
  EXPECT_THAT(check_layout(test_device()), testing::IsEmpty());
  std::string text = embedded_kernels().at("layout.h");
  const std::string members = "  uint sigma_t;", planted = "  uint sigma_u; uint sigma_t;";
  ASSERT_NE(text.find(members), std::string::npos);
  text.replace(text.find(members), members.size(), planted);
  text = std::regex_replace(text, std::regex("LAYOUT_CHECK\\(Medium, 32\\)"), "LAYOUT_CHECK(Medium, 36)");
  const std::vector<std::string> differences = check_layout(test_device(), text);
  EXPECT_THAT(differences, testing::Contains("sizeof(Medium) is 32 on the host, 36 on the device"));
  EXPECT_THAT(differences, testing::Contains("offset of Medium.sigma_t is 0 on the host, 4 on the device"));
}

TEST_F(DeviceTest, TheLayoutListNamesEveryStruct) {
  std::vector<std::string> listed, declared;
  for (const LayoutStruct& type : layout_structs()) listed.push_back(type.name);
  const std::string& text = embedded_kernels().at("layout.h");
  const std::regex check("\nLAYOUT_CHECK\\((\\w+),");
  for (std::sregex_iterator i(text.begin(), text.end(), check), end; i != end; ++i) declared.push_back((*i)[1]);
  EXPECT_EQ(listed, declared);
}

TEST_F(DeviceTest, TheFilmHoldsEverySampleOnceHoweverItIsSplit) {
  Renderer renderer(test::empty_scene(), test_device(), options_);
  const int width = 37, height = 21, crop_x = 5;
  Film film = film_of(width, height, crop_x);
  EXPECT_EQ(renderer.render_samples(film, 9, 0, 13, {}), 13);
  EXPECT_EQ(film.words, expected_film(width, height, crop_x, 9, 0, 13).words);
  EXPECT_EQ(renderer.counters().paths, 37u * 21u * 13u);
  EXPECT_EQ(renderer.counters().rays, 2 * 37u * 21u * 13u);
  // A second call adds to what the film and the counters hold; a film of another size is no trouble.
  EXPECT_EQ(renderer.render_samples(film, 9, 13, 40, {}), 40);
  EXPECT_EQ(film.words, expected_film(width, height, crop_x, 9, 0, 40).words);
  Film small = film_of(2, 1);
  EXPECT_EQ(renderer.render_samples(small, 9, 5, 6, {}), 6);
  EXPECT_EQ(small.words, expected_film(2, 1, 0, 9, 5, 6).words);
  EXPECT_EQ(renderer.counters().paths, 37u * 21u * 40u + 2u);
}

TEST_F(DeviceTest, ProgressCountsUpAndAStopLeavesWholePasses) {
  test::write_kernel_dir(kernels_, 3000);
  Renderer renderer(test::empty_scene(), test_device(), options_);
  const int width = 64, height = 40, many = 1 << 20;
  for (const double stop_after : {0.0, 0.3, 1.5}) {
    Film film = film_of(width, height);
    std::uint64_t last = 0;
    double asked = 0;
    const int end = renderer.render_samples(film, 1, 7, many, [&](const RenderProgress& report) {
      EXPECT_GT(report.samples_done, last);
      EXPECT_EQ(report.samples_total, std::uint64_t(width) * height * (many - 7));
      last = report.samples_done;
      asked = cpu_seconds();
      const bool passes_wanted = stop_after > 1 && report.samples_done < 3 * std::uint64_t(width) * height;
      return report.seconds < stop_after || (passes_wanted && report.seconds < 120);
    });
    EXPECT_LT(cpu_seconds() - asked, 0.5) << "from the stop to the return";
    EXPECT_LT(end, many);
    EXPECT_EQ(film.words, expected_film(width, height, 0, 1, 7, end).words);
    if (stop_after > 1) { EXPECT_GT(end, 7); }
  }
}

TEST_F(DeviceTest, SlowPassesAreDroppedWhole) {
  if (test_device().platform_name == "rusticl") GTEST_SKIP() << "llvmpipe leaves loops after 65,535 iterations";
  // On a few cores a pass takes longer than a stop may, so the one under way must be given up and the film be that of the last copy.
  test::write_kernel_dir(kernels_, 300000);
  Renderer renderer(test::empty_scene(), test_device(), options_);
  const int width = 64, height = 40;
  const std::uint64_t pixels = std::uint64_t(width) * height;
  Film film = film_of(width, height);
  double asked = 0;
  std::uint64_t done = 0;
  const int end = renderer.render_samples(film, 1, 0, 10000, [&](const RenderProgress& report) {
    asked = cpu_seconds();
    done = report.samples_done;
    const std::uint64_t into_pass = done % pixels;
    const bool early_in_a_pass = into_pass > pixels / 8 && into_pass < pixels / 2;
    return !(report.seconds > 2.5 && done > 2 * pixels && early_in_a_pass) && report.seconds < 60;
  });
  EXPECT_LT(cpu_seconds() - asked, 0.5);
  EXPECT_GT(end, 0);
  EXPECT_EQ(film.words, expected_film(width, height, 0, 1, 0, end).words);
  RecordProperty("passes", end);
  RecordProperty("samples dropped", std::to_string(static_cast<long>(done) - end * static_cast<long>(pixels)));
}

TEST_F(DeviceTest, ThreadsCanBeLimited) {
  const DeviceInfo device = test_device();
  if (device.type != "cpu" || device.compute_units < 2) GTEST_SKIP() << "needs a CPU device of two cores";
  options_.threads = 1;
  Renderer renderer(test::empty_scene(), device, options_);
  Film film = film_of(16, 16);
  EXPECT_EQ(renderer.render_samples(film, 9, 0, 4, {}), 4);
  EXPECT_EQ(film.words, expected_film(16, 16, 0, 9, 0, 4).words);
}

TEST_F(DeviceTest, ABuildLogNamesTheTrueFileAndLine) {
  if (test_device().platform_name == "Oclgrind") GTEST_SKIP() << "its log does not follow #line";
  kernels_.write("broken.cl", "// one\n// two\nint broken(void) { return nonesuch; }\n");
  kernels_.write("render.cl", "#include \"layout.h\"\n#include \"broken.cl\"\n" + test::stand_in_kernel());
  try {
    Renderer renderer(test::empty_scene(), test_device(), options_);
    FAIL() << "it built";
  } catch (const KernelBuildError& error) {
    EXPECT_THAT(error.what(), HasSubstr("CL_BUILD_PROGRAM_FAILURE"));
    EXPECT_THAT(error.what(), HasSubstr(test_device().name));
    EXPECT_THAT(error.log(), HasSubstr("broken.cl:3"));
    EXPECT_THAT(error.log(), HasSubstr("nonesuch"));
  }
}

TEST_F(DeviceTest, TheSecondBuildComesFromTheCacheAndADamagedOneIsRebuilt) {
  const DeviceInfo info = test_device();
  const cl::Device device = find_device(info);
  const cl::Context context(device);
  const std::string source = "__kernel void f(__global int* x) { x[0] = 7; }\n";
  const auto build_and_run = [&] {
    const BuiltProgram built = build_program(context, device, info, source, {});
    cl::CommandQueue queue(context, device);
    cl::Buffer out(context, CL_MEM_READ_WRITE, 4);
    cl::Kernel kernel(built.program, "f");
    kernel.setArg(0, out);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, 1, 1);
    cl_int value = 0;
    queue.enqueueReadBuffer(out, CL_TRUE, 0, 4, &value);
    EXPECT_EQ(value, 7);
    store_program(built);
    return built.from_cache;
  };
  EXPECT_FALSE(build_and_run());
  ASSERT_EQ(cached_files().size(), 1u);
  EXPECT_TRUE(build_and_run());
  std::filesystem::resize_file(cached_files()[0], std::filesystem::file_size(cached_files()[0]) / 2);
  EXPECT_FALSE(build_and_run());
  EXPECT_TRUE(build_and_run());
  // Sound on disk, but no program: the driver refuses it and the source is built (but Rusticl ends the process).
  if (info.platform_name == "rusticl") return;
  const BuiltProgram built = build_program(context, device, info, source, {});
  write_cached(cache_folder(), built.cache_key, "no program");
  EXPECT_FALSE(build_and_run());
}

TEST_F(DeviceTest, TooLargeAFilmIsOutOfMemory) {
  const cl::Device device = find_device(test_device());
  try {
    require_memory(device, "the device", 1ull << 50, 1);
    FAIL() << "a pebibyte fitted";
  } catch (const DeviceError& error) {
    EXPECT_TRUE(error.out_of_memory());
    EXPECT_THAT(error.what(), HasSubstr("need 1073741824 MiB, have "));
  }
  EXPECT_NO_THROW(require_memory(device, "the device", 1, 1));
}

TEST_F(DeviceTest, AFailedCallIsNamed) {
  DeviceInfo gone = test_device();
  gone.device = 99;
  EXPECT_THROW(Renderer(test::empty_scene(), gone, options_), DeviceError);
  kernels_.write("render.cl", "__kernel void other(void) {}\n");
  try {
    Renderer renderer(test::empty_scene(), test_device(), options_);
    FAIL() << "a program without the kernel was accepted";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("clCreateKernel"), HasSubstr("CL_INVALID_KERNEL_NAME"), HasSubstr(test_device().name)));
    EXPECT_FALSE(error.out_of_memory());
  }
}

}  // namespace
}  // namespace stokes
