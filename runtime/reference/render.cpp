// Samples into the film: camera, integrator, channels; threads over rows. See reference.h.
#include <atomic>
#include <chrono>
#include <thread>

#include "reference/camera.h"
#include "reference/reference.h"
#include "reference/volpath.h"

namespace stokes::reference {
namespace {

/// The sample's film values in the order of layout.h.
struct SampleValues {
  Vec3d rgb;
  double alpha = 0;
  double aovs[11] = {};
  std::vector<double> bins;
};

void append(double*& out, Vec3d v) { *out++ = v.x, *out++ = v.y, *out++ = v.z; }

Vec3d divide(Vec3d a, Vec3d b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

void fill_aovs(const World& world, const Film& film, const CameraWavelength& camera, const FirstHit& first, const PathResult& path,
               SampleValues& out) {
  double* next = out.aovs;
  if (film.channels & FILM_ALBEDO) append(next, divide(camera.film_weight, world.albedo_white) * first.albedo);
  if (film.channels & FILM_NORMAL) append(next, first.ns);
  if (film.channels & FILM_DEPTH) *next++ = first.depth;
  if (film.channels & FILM_FLUORESCENCE) {
    append(next, camera.film_weight * path.fluorescent);
    *next++ = path.fluorescent * camera.inverse_pdf;
  }
}

/// The camera's wavelength decides the bin; the value is the estimate of the mean radiance per nm in it.
void fill_bins(const Film& film, const CameraWavelength& camera, const PathResult& path, std::vector<double>& bins) {
  bins.assign(static_cast<std::size_t>(film.spectral_bins), 0.0);
  if (film.spectral_bins == 0 || camera.wavelength.channel >= 0) return;
  const double width = (film.spectral_end - film.spectral_begin) / film.spectral_bins;
  const double bin = std::floor((camera.wavelength.nm - film.spectral_begin) / width);
  if (bin >= 0 && bin < film.spectral_bins) bins[static_cast<std::size_t>(bin)] = path.radiance * camera.inverse_pdf / width;
}

SampleValues render_sample(const World& world, const Film& film, std::uint32_t seed, int x, int y, int sample) {
  const layout::Scene& header = world.scene.header;
  const auto pixel = std::uint64_t(y) * header.camera.width + std::uint64_t(x);
  Random random(seed, pixel, std::uint64_t(sample));
  const double u = random.next(), dx = random.next(), dy = random.next(), lens_u = random.next(), lens_v = random.next();
  const CameraWavelength camera = camera_wavelength(world.scene, u);
  const Ray ray = camera_ray(header.camera, x + dx, y + dy, lens_u, lens_v);

  SampleValues values;
  PathResult path;
  const FirstHit first = trace_first_hit(world, ray, camera.wavelength, random);
  values.alpha = first.found ? 1 : 0;
  switch (header.integrator) {
    case layout::INTEGRATOR_NORMALS: values.rgb = {std::abs(first.ns.x), std::abs(first.ns.y), std::abs(first.ns.z)}; break;
    case layout::INTEGRATOR_AO: {
      const double open = trace_ambient_occlusion(world, ray, random);
      values.rgb = {open, open, open};
      break;
    }
    default:
      path = trace_path(world, ray, camera.wavelength, random);
      values.rgb = camera.film_weight * path.radiance;
  }
  fill_aovs(world, film, camera, first, path, values);
  fill_bins(film, camera, path, values.bins);
  return values;
}

void render_row(const World& world, Film& film, std::uint32_t seed, int row, int begin, int end) {
  for (int column = 0; column < film.width; column++)
    for (int sample = begin; sample < end; sample++) {
      const SampleValues values = render_sample(world, film, seed, film.crop_x + column, film.crop_y + row, sample);
      const double rgb[3] = {values.rgb.x, values.rgb.y, values.rgb.z};
      film_add(film, column, row, rgb, values.alpha, values.aovs, values.bins.data());
    }
}

/// The samples [begin, end) of every pixel; each thread takes whole rows, so no pixel has two writers.
void render_pass(const World& world, Film& film, std::uint32_t seed, int begin, int end, int threads) {
  std::atomic<int> next_row{0};
  const auto work = [&] {
    for (int row = next_row++; row < film.height; row = next_row++) render_row(world, film, seed, row, begin, end);
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < std::min(threads, film.height); i++) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
}

}  // namespace

int render_samples(const CompiledScene& scene, Film& film, std::uint32_t seed, int begin, int end, int threads,
                   const std::function<bool(const Progress&)>& progress) {
  const World world(scene);
  const auto start = std::chrono::steady_clock::now();
  const auto pixels = std::uint64_t(film.width) * std::uint64_t(film.height);
  // Passes of some ten thousand paths: long enough to be worth their threads, short enough to be stopped.
  const int pass = static_cast<int>(std::max<std::uint64_t>(1, 65536 / std::max<std::uint64_t>(1, pixels)));
  int done = begin;
  while (done < end) {
    const int next = std::min(end, done + pass);
    render_pass(world, film, seed, done, next, std::max(1, threads));
    done = next;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (progress && !progress({pixels * std::uint64_t(done - begin), pixels * std::uint64_t(end - begin), seconds})) break;
  }
  return done;
}

}  // namespace stokes::reference
