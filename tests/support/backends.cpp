// The two integrators behind one call. See backends.h.
#include "support/backends.h"

#include <cstdlib>
#include <thread>

#include "device/renderer.h"
#include "reference/reference.h"

namespace stokes::tests {
namespace {

Film empty_film(const CompiledScene& scene) {
  const layout::Scene& h = scene.header;
  const int width = int(h.camera.width), height = int(h.camera.height);
  return make_film(width, height, 0, 0, width, height, h.film_channels, int(h.spectral_bins), h.spectral_begin, h.spectral_end, h.film_quantum,
                   h.depth_quantum);
}

}  // namespace

std::uint32_t seed_of(const std::string& name) {
  const char* salt = std::getenv("STOKES_SEED_SALT");
  std::uint32_t h = 2166136261u;
  for (const char c : name + (salt ? salt : "")) h = (h ^ std::uint32_t(static_cast<unsigned char>(c))) * 16777619u;
  return h;
}

Film render_by_reference(const CompiledScene& scene, int spp, std::uint32_t seed) {
  Film film = empty_film(scene);
  reference::render_samples(scene, film, seed, 0, spp, int(std::max(1u, std::thread::hardware_concurrency())), nullptr);
  return film;
}

Film render_by_opencl(const CompiledScene& scene, int spp, std::uint32_t seed, const std::string& kernel_dir) {
  const char* spec = std::getenv("STOKES_DEVICE");
  static const DeviceInfo device = choose_device(spec ? spec : "auto");
  DeviceOptions options;
  options.kernel_dir = kernel_dir;
  Renderer renderer(scene, device, options);
  Film film = empty_film(scene);
  renderer.render_samples(film, seed, 0, spp, nullptr);
  if (const FilmTotals totals = film_totals(film); totals.invalid > 0)
    throw InvalidSamples(std::to_string(totals.invalid) + " invalid samples, the first at pixel " + std::to_string(totals.first_invalid_x) + ", " +
                             std::to_string(totals.first_invalid_y));
  return film;
}

Image reference_backend(const CompiledScene& scene, int spp, std::uint32_t seed) { return develop(render_by_reference(scene, spp, seed), false); }
Image opencl_backend(const CompiledScene& scene, int spp, std::uint32_t seed) { return develop(render_by_opencl(scene, spp, seed), false); }

}  // namespace stokes::tests
