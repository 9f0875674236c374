// What equiangular sampling is for: the noise of lamps' light in thin media, with it and without. Knows scenes and films, no kernels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/backends.h"
#include "support/scene_builder.h"

namespace stokes::tests {
namespace {

/// A small lamp in thin fog before a black wall, seen from within; some of the film sees the lamp itself.
CompiledScene lamp_in_fog(bool equiangular, bool chromatic, ColorMode mode) {
  SceneDescription scene = empty_scene(parallel_camera(0, 2, 1, 24), IntegratorKind::Mis, mode);
  scene.integrator.equiangular = equiangular;
  auto fog = std::make_shared<MediumDescription>(*medium(0.1, 0.9, 0.3));
  if (chromatic) fog->sigma_t = sum({box(280, 550, 0.05), box(550, 780, 0.15)});
  SurfaceDescription lamp = sphere({}, 0.02, black()), wall = horizontal_square(-1, 10, black());
  lamp.emit = number(100);
  lamp.outside = wall.outside = scene.camera.medium.emplace(fog);
  scene.surfaces = {lamp, wall};
  return compile_scene(scene);
}

struct Noise {
  double mean = 0, variance = 0;  ///< of one sample's luminance, over the pixels that do not see the lamp
};

using Backend = Film (*)(const CompiledScene&, int, std::uint32_t);

Noise noise_of(const CompiledScene& scene, Backend backend) {
  constexpr int kSamples = 256;
  const Image image = develop(backend(scene, kSamples, 11), true);
  const std::vector<float>&mean = image.find("G")->values, &variance = image.find("Variance.G")->values;
  Noise noise;
  int pixels = 0;
  for (int y = 0; y < image.height; y++)
    for (int x = 0; x < image.width; x++) {
      if (std::hypot(x + 0.5 - image.width / 2.0, y + 0.5 - image.height / 2.0) < 2) continue;
      const std::size_t i = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
      noise.mean += double(mean[i]);
      noise.variance += double(variance[i]) * kSamples;
      pixels++;
    }
  return {noise.mean / pixels, noise.variance / pixels};
}

Film by_opencl(const CompiledScene& scene, int spp, std::uint32_t seed) { return render_by_opencl(scene, spp, seed); }

/// The reference draws one wavelength a path, so more of its noise is colour.
void expect_less_noise(bool chromatic, ColorMode mode) {
  for (const auto& [name, backend] : {std::pair<const char*, Backend>("OpenCL", by_opencl), std::pair<const char*, Backend>("reference", render_by_reference)}) {
    const Noise without = noise_of(lamp_in_fog(false, chromatic, mode), backend), with = noise_of(lamp_in_fog(true, chromatic, mode), backend);
    std::printf("%s, %s, %s: mean %.5g and %.5g, variance of one sample %.4g and %.4g: %.1f times less\n", name, chromatic ? "chromatic" : "grey",
                mode == ColorMode::Rgb ? "rgb" : "spectral", without.mean, with.mean, without.variance, with.variance, without.variance / with.variance);
    EXPECT_GE(without.variance, (backend == Backend(by_opencl) ? 10 : 5) * with.variance) << name;
    EXPECT_NEAR(with.mean / without.mean, 1, 0.1) << name;
  }
}

TEST(Airlight, EquiangularSamplingHasLessNoise) { expect_less_noise(false, ColorMode::Rgb); }
TEST(Airlight, AlsoInFogOfAColour) { expect_less_noise(true, ColorMode::Spectral); }

// It is for thin media and small lamps; other scenes are rendered as if it were not there.
TEST(Airlight, ThinMediaAreMarked) {
  EXPECT_TRUE(lamp_in_fog(true, false, ColorMode::Rgb).features.thin_media);
  EXPECT_FALSE(lamp_in_fog(false, false, ColorMode::Rgb).features.thin_media);
  const auto marked = [](double sigma_t, double albedo, double radius, bool lamp, IntegratorKind integrator) {
    SceneDescription scene = empty_scene(parallel_camera(0, 2, 1, 8), integrator, ColorMode::Rgb);
    SurfaceDescription ball = sphere({}, 1, interface_material()), inner = sphere({}, radius, black());
    ball.inside = inner.outside = medium(sigma_t, albedo, 0);
    if (lamp) inner.emit = number(1);
    scene.surfaces = {ball, inner};
    scene.background.emission = number(1);
    const CompiledScene compiled = compile_scene(scene);
    EXPECT_EQ(compiled.features.thin_media, (compiled.media[1].flags & MEDIUM_THIN) != 0);
    return compiled.features.thin_media;
  };
  EXPECT_TRUE(marked(0.5, 0.5, 0.02, true, IntegratorKind::Mis));
  EXPECT_TRUE(marked(0.5, 0.5, 0.02, true, IntegratorKind::Nee));
  EXPECT_FALSE(marked(0.5, 0.5, 0.02, true, IntegratorKind::Mats)) << "no light is sought";
  EXPECT_FALSE(marked(0.5, 0.5, 0.02, false, IntegratorKind::Mis)) << "no lamp";
  EXPECT_FALSE(marked(0.5, 0.0, 0.02, true, IntegratorKind::Mis)) << "nothing scatters";
  EXPECT_FALSE(marked(10, 0.5, 0.001, true, IntegratorKind::Mis)) << "dense";
  EXPECT_FALSE(marked(0.5, 0.5, 0.5, true, IntegratorKind::Mis)) << "a large lamp";
}

}  // namespace
}  // namespace stokes::tests
