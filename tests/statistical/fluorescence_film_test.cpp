// What fluorescence leaves in the film: its own channels, alike by both integrators, and its noise. Knows scenes and films, no kernels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "layout.h"
#include "scene/read_scene.h"
#include "support/backends.h"
#include "support/scene_builder.h"

namespace stokes::tests {
namespace {

using Backend = Film (*)(const CompiledScene&, int, std::uint32_t);

Film by_opencl(const CompiledScene& scene, int spp, std::uint32_t seed) { return render_by_opencl(scene, spp, seed); }

CompiledScene small(const std::string& name, std::uint32_t channels) {
  SceneDescription scene = read_scene(std::string(STOKES_SOURCE_DIR) + "/scenes/" + name + ".json");
  scene.camera.width = scene.camera.height_pixels = 16;
  CompileOptions options;
  options.film_channels = channels;
  return compile_scene(scene, options);
}

struct Mean {
  double value = 0, error = 0;
};

/// Whole images with seeds of their own: mean and standard error of each channel's image mean.
std::vector<Mean> channel_means(const CompiledScene& scene, Backend backend, const std::vector<std::string>& channels, const std::string& name) {
  constexpr int kImages = 16, kSamples = 12;
  std::vector<double> sum(channels.size()), squares(channels.size());
  for (int i = 0; i < kImages; i++) {
    const Image image = develop(backend(scene, kSamples, seed_of(name + std::to_string(i))), false);
    for (std::size_t c = 0; c < channels.size(); c++) {
      const Image::Channel* found = image.find(channels[c]);
      if (!found) throw std::runtime_error("no channel " + channels[c]);
      double mean = 0;
      for (float v : found->values) mean += double(v) / double(found->values.size());
      sum[c] += mean;
      squares[c] += mean * mean;
    }
  }
  std::vector<Mean> means;
  for (std::size_t c = 0; c < channels.size(); c++) {
    const double mean = sum[c] / kImages;
    means.push_back({mean, std::sqrt(std::max(0.0, squares[c] / kImages - mean * mean) / (kImages - 1))});
  }
  return means;
}

const std::vector<std::string> kFluorescence = {"Fluorescence.R", "Fluorescence.G", "Fluorescence.B", "Fluorescence.Energy"};

/// A ball of dyed fog without a surface of its own, under a sky from 340 to 400 nm.
CompiledScene dyed_ball() {
  SceneDescription scene = empty_scene(parallel_camera(20, 4, 2, 16), IntegratorKind::Mis, ColorMode::Spectral);
  MediumDescription fog = *medium(1.5, 0.6, 0.4);
  DyeDescription dye;
  dye.absorption = box(350, 450, 2);
  dye.emission = box(480, 560, 1);
  dye.yield = 0.8;
  fog.dyes = {dye};
  SurfaceDescription ball = sphere({0, 0, 0}, 0.9, interface_material());
  ball.inside = std::make_shared<const MediumDescription>(fog);
  scene.surfaces = {ball};
  scene.background.emission = box(340, 400, 5);
  CompileOptions options;
  options.film_channels = FILM_FLUORESCENCE;
  return compile_scene(scene, options);
}

// Dyes on surfaces under white light, a measured matrix, dyes in a medium. With 12 tests, |z| > 4 happens once in 1300 runs.
void expect_agreement(const std::string& name, const CompiledScene& scene) {
  const std::vector<Mean> device = channel_means(scene, by_opencl, kFluorescence, "opencl " + name);
  const std::vector<Mean> truth = channel_means(scene, render_by_reference, kFluorescence, "reference " + name);
  for (std::size_t c = 0; c < kFluorescence.size(); c++) {
    const double error = std::hypot(device[c].error, truth[c].error), z = (device[c].value - truth[c].value) / error;
    std::printf("%s %s: %.6g against %.6g, z %.2f\n", name.c_str(), kFluorescence[c].c_str(), device[c].value, truth[c].value, z);
    EXPECT_LE(std::abs(z), 4) << name << " " << kFluorescence[c];
  }
  EXPECT_LE(std::hypot(device[3].error, truth[3].error), 0.05 * truth[3].value) << name << ": too noisy to say anything";
}

TEST(FluorescenceFilm, BothIntegratorsAgree) {
  for (const std::string name : {"fluorescent_box", "reradiation"}) expect_agreement(name, small(name, FILM_FLUORESCENCE));
  expect_agreement("dyed ball", dyed_ball());
}

// Under a lamp below 360 nm the eye sees fluorescence or nothing, sample by sample.
TEST(FluorescenceFilm, UnderAnInvisibleLampItIsAllThereIs) {
  const CompiledScene scene = small("fluorescent_one_dye", FILM_FLUORESCENCE);
  for (const Backend backend : {by_opencl, Backend(render_by_reference)}) {
    const Image image = develop(backend(scene, 8, 1), false);
    double light = 0;
    for (const char* c : {"R", "G", "B"}) {
      EXPECT_EQ(image.find(c)->values, image.find(std::string("Fluorescence.") + c)->values) << c;
      for (float v : image.find(c)->values) light += std::abs(v);
    }
    EXPECT_GT(light, 0);
  }
}

// The spectrum of what fluoresces adds up to its energy, sample by sample, and lies where the lamp's light (below 360 nm) does not.
TEST(FluorescenceFilm, ItsSpectrumAddsUpToItsEnergy) {
  constexpr int kBins = 25;
  CompileOptions options;
  options.film_channels = FILM_FLUORESCENCE | FILM_FLUORESCENT_BINS;
  options.spectral_bins = kBins, options.spectral_begin = 280, options.spectral_end = 780;
  SceneDescription description = read_scene(STOKES_SOURCE_DIR "/scenes/fluorescent_one_dye.json");
  description.camera.width = description.camera.height_pixels = 16;
  const CompiledScene scene = compile_scene(description, options);
  for (const Backend backend : {by_opencl, Backend(render_by_reference)}) {
    const Image image = develop(backend(scene, 8, 1), false);
    const std::vector<float>& energy = image.find("Fluorescence.Energy")->values;
    std::vector<double> sum(energy.size(), 0.0);
    double reflected = 0, excited = 0;
    for (int bin = 0; bin < kBins; bin++) {
      const std::string name = spectral_channel_name(280 + (bin + 0.5) * 20);
      const std::vector<float>&all = image.find(name)->values, &fluorescent = image.find("Fluorescence." + name)->values;
      for (std::size_t i = 0; i < sum.size(); i++) {
        sum[i] += 20.0 * double(fluorescent[i]);
        excited += double(fluorescent[i]);
        reflected += double(all[i]) - double(fluorescent[i]);
        if (bin >= 4) {
          EXPECT_EQ(fluorescent[i], all[i]) << name;
        }
      }
    }
    for (std::size_t i = 0; i < sum.size(); i++) EXPECT_NEAR(sum[i], double(energy[i]), 1e-4 * double(energy[i]) + 1e-6);
    EXPECT_GT(excited, 0);
    EXPECT_GT(reflected, 0);
  }
}

/// A plane seen straight on, under a small lamp whose direction brings no noise.
SceneDescription lit_plane(int wavelengths, MaterialPtr material, SpectrumPtr light) {
  SceneDescription scene = empty_scene(parallel_camera(0, 1, 0.01, 32), IntegratorKind::Mis, ColorMode::Spectral);
  scene.integrator.wavelengths_per_path = wavelengths;
  scene.integrator.max_bounces = 1;
  SurfaceDescription lamp = rectangle(frame({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 2}), 0.1, 0.1, black());
  lamp.emit = std::move(light);
  scene.surfaces = {horizontal_square(0, 1, std::move(material)), lamp};
  return scene;
}

MaterialPtr dyed(SpectrumPtr emission, double albedo) {
  auto material = std::make_shared<MaterialDescription>();
  material->kind = MaterialKind::DiffuseFluorescent;
  material->albedo.spectrum = number(albedo);
  DyeDescription dye;
  dye.absorption = box(320, 420, 0.9);
  dye.emission = std::move(emission);
  dye.yield = 0.9;
  material->dyes = {dye};
  return material;
}

/// Standard deviation of one sample over the mean, of the brightest channel.
double relative_deviation(const CompiledScene& scene) {
  constexpr int kSamples = 512;
  const Image image = develop(render_by_opencl(scene, kSamples, 5), true);
  double best = 0, deviation = 0;
  for (const char* c : {"R", "G", "B"}) {
    double mean = 0, variance = 0;
    for (float v : image.find(c)->values) mean += v;
    for (float v : image.find(std::string("Variance.") + c)->values) variance += v;
    const double n = double(image.find(c)->values.size());
    if (mean > best) {
      best = mean;
      deviation = std::sqrt(variance / n * kSamples) / (mean / n);
    }
  }
  return deviation;
}

// A plane under an ultraviolet lamp, against a white one under a lamp of the dye's colour: the camera's own choice of wavelengths is in both.
// Excitation drawn from the absorption alone would add a deviation of 2.0 here, and from the visible range everything.
TEST(FluorescenceFilm, OneSampleDeviatesByLittle) {
  const SpectrumPtr ultraviolet = box(355, 375, 100);
  for (const int n : {1, 4})
    for (const auto& [name, emission] : {std::pair("480-560 nm", box(480, 560, 1)), std::pair("380-780 nm", box(380, 780, 1))})
      for (const double albedo : {0.0, 0.6}) {
        const double fluorescent = relative_deviation(compile_scene(lit_plane(n, dyed(emission, albedo), ultraviolet)));
        const double reflected = relative_deviation(compile_scene(lit_plane(n, lambertian(0.8), emission)));
        const double added = std::sqrt(std::max(0.0, fluorescent * fluorescent - reflected * reflected));
        std::printf("%d wavelengths, emission %s, base %.1f: %.3f, reflected light %.3f, added %.3f\n", n, name, albedo, fluorescent, reflected, added);
        if (n == 4) {
          EXPECT_LE(fluorescent, 1.1) << name;
        }
        EXPECT_LE(fluorescent * fluorescent, (1 + reflected * reflected) * (1 + 1.1 * 1.1) - 1) << n << " wavelengths, " << name;
      }
}

}  // namespace
}  // namespace stokes::tests
