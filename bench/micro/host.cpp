// What happens on the host before the first ray: trees, scenes, spectra.
#include <benchmark/benchmark.h>

#include <cmath>

#include "compiled/bvh.h"
#include "compiled/compiled_scene.h"
#include "scene/read_scene.h"
#include "spectral/tabulate.h"

namespace {

using namespace stokes;

/// A closed bumpy sphere of about `count` triangles.
void bumpy_sphere(int count, std::vector<layout::Vec3>& positions, std::vector<layout::Triangle>& triangles) {
  const int rows = std::max(3, static_cast<int>(std::sqrt(count / 4.0))), columns = 2 * rows;
  for (int i = 0; i <= rows; i++)
    for (int j = 0; j < columns; j++) {
      const double theta = M_PI * i / rows, phi = 2 * M_PI * j / columns;
      const double r = 1 + 0.05 * std::sin(13 * theta) * std::sin(11 * phi);
      positions.push_back({static_cast<float>(r * std::sin(theta) * std::cos(phi)), static_cast<float>(r * std::cos(theta)),
                           static_cast<float>(r * std::sin(theta) * std::sin(phi))});
    }
  const auto at = [&](int i, int j) { return static_cast<layout::uint>(i * columns + j % columns); };
  for (int i = 0; i < rows; i++)
    for (int j = 0; j < columns; j++) {
      layout::Triangle t{};
      t.v0 = at(i, j), t.v1 = at(i, j + 1), t.v2 = at(i + 1, j);
      if (i > 0) triangles.push_back(t);
      t.v0 = at(i + 1, j), t.v1 = at(i, j + 1), t.v2 = at(i + 1, j + 1);
      if (i + 1 < rows) triangles.push_back(t);
    }
}

void build_bvh(benchmark::State& state) {
  std::vector<layout::Vec3> positions;
  std::vector<layout::Triangle> triangles;
  bumpy_sphere(static_cast<int>(state.range(0)), positions, triangles);
  for (auto _ : state) benchmark::DoNotOptimize(compiled::build_bvh(positions, triangles, static_cast<int>(state.range(1))));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles.size()));
  state.SetComplexityN(static_cast<std::int64_t>(triangles.size()));
}
BENCHMARK(build_bvh)->ArgsProduct({{10000, 100000, 1000000}, {8}})->ArgsProduct({{100000}, {2, 4}})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void read_scene(benchmark::State& state, const char* file) {
  for (auto _ : state) benchmark::DoNotOptimize(stokes::read_scene(std::string(STOKES_SOURCE_DIR "/bench/scenes/") + file));
}
BENCHMARK_CAPTURE(read_scene, s2, "s2.json")->Unit(benchmark::kMillisecond);

void compile_scene(benchmark::State& state, const char* file) {
  const SceneDescription scene = stokes::read_scene(std::string(STOKES_SOURCE_DIR "/bench/scenes/") + file);
  for (auto _ : state) benchmark::DoNotOptimize(stokes::compile_scene(scene));
}
BENCHMARK_CAPTURE(compile_scene, s2, "s2.json")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile_scene, fluorescent_box, "fluorescent_box.json")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile_scene, textured_box, "textured_box.json")->Unit(benchmark::kMillisecond);

void upsample(benchmark::State& state) {
  double x = 0.1;
  for (auto _ : state) {
    x = x > 0.8 ? 0.1 : x + 0.037;
    benchmark::DoNotOptimize(fit_sigmoid({x, 0.9 - x, 0.3}));
  }
}
BENCHMARK(upsample)->Unit(benchmark::kMicrosecond);

}  // namespace
