// What the reference writes into the film beside radiance, and that the film depends on scene, seed and samples alone.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/reference.h"
#include "support/scene_builder.h"

namespace stokes::tests {
namespace {

constexpr int kPixels = 8;

Film render(const CompiledScene& scene, int x, int y, int width, int height, std::uint32_t seed, int begin, int end, int threads) {
  const layout::Scene& h = scene.header;
  Film film = make_film(int(h.camera.width), int(h.camera.height), x, y, width, height, h.film_channels, int(h.spectral_bins), h.spectral_begin,
                        h.spectral_end, h.film_quantum, h.depth_quantum);
  EXPECT_EQ(reference::render_samples(scene, film, seed, begin, end, threads, nullptr), end);
  return film;
}

/// A sphere on a floor, a square light, a little fog: enough to use every part of the loop.
SceneDescription small_scene(IntegratorKind integrator) {
  SceneDescription scene = empty_scene(parallel_camera(40, 4, 2, kPixels), integrator, ColorMode::Spectral);
  SurfaceDescription ball = sphere({0, 0, 0.5}, 0.5, interface_material());
  ball.inside = medium(4, 0.8, 0.3);
  SurfaceDescription light = rectangle(frame({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 2}), 1, 1, black());
  light.emit = number(5);
  scene.surfaces = {horizontal_square(0, 3, lambertian(0.6)), ball, light};
  return scene;
}

const std::vector<float>& channel(const Image& image, const std::string& name) {
  const Image::Channel* c = image.find(name);
  EXPECT_TRUE(c) << name;
  return c->values;
}

TEST(ReferenceFilm, DoesNotDependOnThreads) {
  const CompiledScene scene = compile_scene(small_scene(IntegratorKind::Mis));
  const Film one = render(scene, 0, 0, kPixels, kPixels, 3, 0, 8, 1), three = render(scene, 0, 0, kPixels, kPixels, 3, 0, 8, 3);
  EXPECT_EQ(one.words, three.words);
  EXPECT_NE(one.words, render(scene, 0, 0, kPixels, kPixels, 4, 0, 8, 1).words);
}

TEST(ReferenceFilm, SumsOfPartsAreTheWhole) {
  const CompiledScene scene = compile_scene(small_scene(IntegratorKind::Mis));
  const Film whole = render(scene, 0, 0, kPixels, kPixels, 3, 0, 8, 2);
  // Samples in two parts, into one film.
  Film parts = render(scene, 0, 0, kPixels, kPixels, 3, 0, 5, 2);
  reference::render_samples(scene, parts, 3, 5, 8, 2, nullptr);
  EXPECT_EQ(whole.words, parts.words);
  // A window is that part of the picture.
  const Film window = render(scene, 2, 3, 4, 2, 3, 0, 8, 1);
  for (int y = 0; y < 2; y++)
    for (int x = 0; x < 4; x++)
      for (int w = 0; w < whole.stride; w++)
        ASSERT_EQ(window.words[std::size_t((y * 4 + x) * whole.stride + w)], whole.words[std::size_t(((y + 3) * kPixels + x + 2) * whole.stride + w)]);
}

TEST(ReferenceFilm, StopsWhenAsked) {
  const CompiledScene scene = compile_scene(small_scene(IntegratorKind::Mis));
  Film film = make_film(kPixels, kPixels, 0, 0, kPixels, kPixels, 0, 0, 0, 0, scene.header.film_quantum, scene.header.depth_quantum);
  const int done = reference::render_samples(scene, film, 1, 0, 100000, 1, [](const reference::Progress&) { return false; });
  EXPECT_LT(done, 100000);
  const std::int64_t samples = film.words[10];
  EXPECT_EQ(samples, done);
}

TEST(ReferenceFilm, HoldsAlphaDepthNormalAndAlbedo) {
  SceneDescription description = empty_scene(parallel_camera(0, 3, 0.5, kPixels), IntegratorKind::Mis, ColorMode::Spectral);
  description.surfaces = {horizontal_square(1, 10, lambertian(0.4))};
  description.background.emission = number(1);
  CompileOptions options;
  options.film_channels = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH;
  const CompiledScene scene = compile_scene(description, options);
  const Image image = develop(render(scene, 0, 0, kPixels, kPixels, 1, 0, 4000, 2), false);
  double albedo[3] = {};
  for (std::size_t i = 0; i < kPixels * kPixels; i++) {
    EXPECT_NEAR(channel(image, "A")[i], 1, 1e-6);
    EXPECT_NEAR(channel(image, "Z")[i], 2, 1e-5);
    EXPECT_NEAR(channel(image, "N.Z")[i], 1, 1e-6);
    albedo[0] += channel(image, "Albedo.R")[i] / (kPixels * kPixels);
    albedo[1] += channel(image, "Albedo.G")[i] / (kPixels * kPixels);
    albedo[2] += channel(image, "Albedo.B")[i] / (kPixels * kPixels);
  }
  for (const double a : albedo) EXPECT_NEAR(a, 0.4, 0.01);
}

TEST(ReferenceFilm, NormalsAndAmbientOcclusion) {
  // A floor seen from above: its normal is +z and nothing hides the sky; under a lid nothing is open.
  SceneDescription description = empty_scene(parallel_camera(0, 0.5, 0.2, kPixels), IntegratorKind::Normals, ColorMode::Spectral);
  description.surfaces = {horizontal_square(0, 10, lambertian(0.4))};
  const auto mean = [&](const char* name) {
    const Image image = develop(render(compile_scene(description), 0, 0, kPixels, kPixels, 1, 0, 16, 1), false);
    double sum = 0;
    for (const float v : channel(image, name)) sum += v;
    return sum / (kPixels * kPixels);
  };
  EXPECT_NEAR(mean("R"), 0, 1e-6);
  EXPECT_NEAR(mean("B"), 1, 1e-6);
  description.integrator.kind = IntegratorKind::Ao;
  EXPECT_NEAR(mean("G"), 1, 1e-6);
  description.surfaces.push_back(horizontal_square(1, 1000, lambertian(0.4)));
  EXPECT_LT(mean("G"), 0.01);
}

}  // namespace
}  // namespace stokes::tests
