// One image, bit for bit: whatever the lane count, the number of threads, and however pixels and samples are cut into launches. Each scene
// is rendered in several ways and every word of the film is compared. Knows no OpenCL and no truth: all ways may be wrong alike.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "compiled/compiled_scene.h"
#include "compiled/look_from.h"
#include "device/renderer.h"
#include "differential/lane_scenes.h"
#include "image/film.h"
#include "scene/read_scene.h"

namespace stokes::tests {
namespace {

constexpr int kSamples = 6;
constexpr std::uint32_t kSeed = 7;

struct Window {
  int x, y, width, height;
};

CompiledScene compile(const char* scene, unsigned channels, int bins = 0) {
  CompileOptions options;
  options.film_channels = channels;
  options.spectral_bins = bins;
  options.spectral_begin = 400;
  options.spectral_end = 700;
  return compile_scene(read_scene_text(scene, "scene.json", STOKES_SOURCE_DIR "/scenes"), options);
}

Window whole(const CompiledScene& scene) { return {0, 0, int(scene.header.camera.width), int(scene.header.camera.height)}; }

Renderer make_renderer(const CompiledScene& scene, int lanes, int threads = 0) {
  const char* spec = std::getenv("STOKES_DEVICE");
  static const DeviceInfo device = choose_device(spec ? spec : "auto");
  DeviceOptions options;
  options.lanes = lanes;
  options.threads = threads;
  // For planting bugs and watching these tests fail.
  if (const char* folder = std::getenv("STOKES_KERNEL_DIR")) options.kernel_dir = folder;
  return Renderer(scene, device, options);
}

Film empty_film(const CompiledScene& scene, const Window& w) {
  const layout::Scene& h = scene.header;
  return make_film(int(h.camera.width), int(h.camera.height), w.x, w.y, w.width, w.height, h.film_channels, int(h.spectral_bins),
                   h.spectral_begin, h.spectral_end, h.film_quantum, h.depth_quantum);
}

Film render(const CompiledScene& scene, Renderer& renderer, const Window& window, int begin = 0, int end = kSamples) {
  Film film = empty_film(scene, window);
  EXPECT_EQ(renderer.render_samples(film, kSeed, begin, end, nullptr), end);
  return film;
}

/// Empty where the window's words are those of the same pixels of `image`, else what differs.
std::string difference(const Film& image, const Film& window) {
  int words = 0;
  std::ostringstream first;
  for (int y = 0; y < window.height; y++)
    for (int x = 0; x < window.width; x++)
      for (int k = 0; k < window.stride; k++) {
        const std::int64_t a = film_pixel(image, window.crop_x + x, window.crop_y + y)[k], b = film_pixel(window, x, y)[k];
        if (a != b && words++ == 0) first << "; first word " << k << " of pixel " << window.crop_x + x << ", " << window.crop_y + y << ": " << a << " and " << b;
      }
  return words == 0 ? "" : std::to_string(words) + " words differ" + first.str();
}

void expect_same_counters(const RenderCounters& a, const RenderCounters& b) {
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.shadow_rays, b.shadow_rays);
  EXPECT_EQ(a.scatterings, b.scatterings);
  EXPECT_EQ(a.paths, b.paths);
  EXPECT_EQ(a.invalid, 0u);
}

/// Renders with 8 lanes whole, in windows and in parts, then with other lane counts.
void expect_one_image(const CompiledScene& scene, std::initializer_list<int> other_lanes) {
  const Window all = whole(scene);
  Renderer renderer = make_renderer(scene, 8);
  const Film image = render(scene, renderer, all);
  const RenderCounters counters = renderer.counters();
  ASSERT_GT(counters.rays, counters.paths) << "the scene shows nothing";

  // Windows change which pixels a work-item gets, and where its run of them ends.
  for (const Window& w : {Window{0, 0, all.width, 1}, Window{5, 3, 7, 5}, Window{all.width - 1, 0, 1, all.height}})
    EXPECT_EQ(difference(image, render(scene, renderer, w)), "") << "window " << w.width << "x" << w.height;
  Film parts = render(scene, renderer, all, 0, 1);
  film_accumulate(parts, render(scene, renderer, all, 1, 4));
  film_accumulate(parts, render(scene, renderer, all, 4, kSamples));
  EXPECT_EQ(difference(image, parts), "") << "samples in three parts";

  for (const int lanes : other_lanes) {
    SCOPED_TRACE(std::to_string(lanes) + " lanes");
    Renderer other = make_renderer(scene, lanes);
    EXPECT_EQ(difference(image, render(scene, other, all)), "");
    expect_same_counters(counters, other.counters());
  }
}

constexpr unsigned kAllChannels = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH;

TEST(LanesTest, Surfaces) { expect_one_image(compile(kSurfacesScene, kAllChannels, 5), {1}); }
TEST(LanesTest, Media) { expect_one_image(compile(kMediaScene, 0), {1, 16}); }
TEST(LanesTest, ThinFog) {
  const CompiledScene scene = compile(kThinFogScene, FILM_DEPTH);
  ASSERT_TRUE(scene.features.thin_media);
  expect_one_image(scene, {1});
}
TEST(LanesTest, Fluorescence) { expect_one_image(compile(kFluorescenceScene, FILM_FLUORESCENCE | FILM_FLUORESCENT_BINS, 5), {1}); }
TEST(LanesTest, Rgb) { expect_one_image(compile(kRgbScene, kAllChannels), {1}); }

TEST(LanesTest, ThreadsDoNotShow) {
  const CompiledScene scene = compile(kRgbScene, kAllChannels);
  Renderer all = make_renderer(scene, 8), one = make_renderer(scene, 8, 1);
  EXPECT_EQ(difference(render(scene, all, whole(scene)), render(scene, one, whole(scene))), "");
  expect_same_counters(all.counters(), one.counters());
}

// A renderer whose camera was moved, and one of a scene that was compiled with that camera.
TEST(LanesTest, AMovedCameraSeesWhatACompiledOneSees) {
  SceneDescription description = read_scene_text(kMediaScene, "scene.json", STOKES_SOURCE_DIR "/scenes");
  CompileOptions options;
  options.film_channels = FILM_DEPTH;
  CompiledScene scene = compile_scene(description, options);
  Renderer renderer = make_renderer(scene, 8);
  const Film before = render(scene, renderer, whole(scene));

  CameraDescription& camera = description.camera;
  camera.transform.m[3] += 0.25;  // sideways
  camera.width /= 2;
  camera.vfov *= 0.8;
  const CompiledScene there = compile_scene(description, options);
  scene.header = look_from(scene, camera);
  EXPECT_EQ(std::memcmp(&scene.header, &there.header, sizeof scene.header), 0);
  renderer.set_header(scene.header);
  const Film moved = render(scene, renderer, whole(scene));
  Renderer other = make_renderer(there, 8);
  EXPECT_EQ(difference(moved, render(there, other, whole(there))), "");
  EXPECT_NE(moved.words, before.words);
}

TEST(LanesTest, AnotherSeedIsAnotherImage) {
  const CompiledScene scene = compile(kRgbScene, kAllChannels);
  Renderer renderer = make_renderer(scene, 8);
  const Film image = render(scene, renderer, whole(scene));
  Film other = empty_film(scene, whole(scene));
  renderer.render_samples(other, kSeed + 1, 0, kSamples, nullptr);
  EXPECT_NE(difference(image, other), "");
}

// A few paths of a thick medium that absorbs little outlive all others. Launches adapt, so that lanes do not wait for them most of the time,
// and the image does not.
TEST(LanesTest, AreBusyWhereFewPathsAreVeryLong) {
  const CompiledScene scene = compile(kThickBallScene, 0);
  constexpr int kMany = 256;
  Renderer renderer = make_renderer(scene, 8, 1);
  Film film = empty_film(scene, whole(scene));
  renderer.render_samples(film, kSeed, 0, kMany, nullptr);
  const RenderCounters& c = renderer.counters();
  std::printf("flights %llu of %llu lane steps\n", static_cast<unsigned long long>(c.flights), static_cast<unsigned long long>(c.lane_steps));
  EXPECT_GT(static_cast<double>(c.flights), 0.5 * static_cast<double>(c.lane_steps));

  Film parts = empty_film(scene, whole(scene));
  Renderer other = make_renderer(scene, 8);
  for (int i = 0; i < kMany; i += kMany / 4) film_accumulate(parts, render(scene, other, whole(scene), i, i + kMany / 4));
  EXPECT_EQ(difference(film, parts), "");
}

}  // namespace
}  // namespace stokes::tests
