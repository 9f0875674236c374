// Renders a small scene many times in one process and watches its memory: repeated_renders SCENE.json [COUNT=1000]. Each render reads and compiles
// the scene, makes a renderer and renders all samples. Exit code 1 when the memory grew by 1 % or more after the first 50.
#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "compiled/compiled_scene.h"
#include "device/renderer.h"
#include "scene/read_scene.h"

namespace {

constexpr int kSettled = 50;

/// Resident memory in KiB, without what the heap holds free: how that is spread over its arenas is chance.
long resident() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  long size = 0, pages = 0;
  file >> size >> pages;
  return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

// The sum of the film's words, which may wrap.
std::uint64_t render(const char* path, const stokes::DeviceInfo& device) {
  stokes::CompileOptions options;
  options.bvh_width = stokes::default_bvh_width(device);
  const stokes::CompiledScene scene = stokes::compile_scene(stokes::read_scene(path), options);
  stokes::Renderer renderer(scene, device);
  const stokes::layout::Scene& h = scene.header;
  stokes::Film film = stokes::make_film(16, 12, 0, 0, 8, 8, h.film_channels, 0, 0, 0, static_cast<double>(h.film_quantum), static_cast<double>(h.depth_quantum));
  renderer.render_samples(film, scene.seed, 0, 4, {});
  std::uint64_t sum = 0;
  for (const std::int64_t word : film.words) sum += static_cast<std::uint64_t>(word);
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const int count = argc > 2 ? std::atoi(argv[2]) : 1000;
  const stokes::DeviceInfo device = stokes::choose_device("auto");
  long settled = 0;
  std::uint64_t first = 0;
  for (int i = 1; i <= count; i++) {
    const std::uint64_t sum = render(argv[1], device);
    if (i == 1) first = sum;
    if (sum != first) {
      std::printf("FAILED: render %d differs from the first\n", i);
      return 1;
    }
    if (i == kSettled) settled = resident();
  }
  const long end = resident();
  const double growth = 100.0 * static_cast<double>(end - settled) / static_cast<double>(settled);
  std::printf("resident memory: %ld KiB after %d renders, %ld KiB after %d: %+.2f %%\n", settled, kSettled, end, count, growth);
  return count > kSettled && growth >= 1 ? 1 : 0;
}
