// Samples into the film: camera, integrator, channels; threads over rows. See reference.h.
#include <atomic>
#include <chrono>
#include <thread>

#include "reference/camera.h"
#include "reference/medium.h"
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
  const bool apart = film.channels & FILM_FLUORESCENT_BINS;
  bins.assign(static_cast<std::size_t>(film.spectral_bins * (apart ? 2 : 1)), 0.0);
  if (film.spectral_bins == 0 || camera.wavelength.channel >= 0) return;
  const double width = (film.spectral_end - film.spectral_begin) / film.spectral_bins;
  const double bin = std::floor((camera.wavelength.nm - film.spectral_begin) / width);
  if (!(bin >= 0 && bin < film.spectral_bins)) return;
  bins[static_cast<std::size_t>(bin)] = path.radiance * camera.inverse_pdf / width;
  if (apart) bins[static_cast<std::size_t>(bin) + static_cast<std::size_t>(film.spectral_bins)] = path.fluorescent * camera.inverse_pdf / width;
}

/// Whether the camera stands in a medium that attenuates: seen without end, that is opaque.
bool fills_the_view(const CompiledScene& scene, Wavelength w) {
  const bool traces = scene.header.integrator != layout::INTEGRATOR_NORMALS && scene.header.integrator != layout::INTEGRATOR_AO;
  return traces && medium_at(scene, scene.header.camera.medium, w).sigma_t > 0;
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
  values.alpha = first.found || fills_the_view(world.scene, camera.wavelength) ? 1 : 0;
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

/// The samples [begin, end) of every pixel; each thread takes whole rows, so no pixel has two writers. The calling thread asks
/// `keep_going` after each of its rows. Returns false when the pass was left unfinished; the film is then of no use.
bool render_pass(const World& world, Film& film, std::uint32_t seed, int begin, int end, int threads,
                 const std::function<bool(int rows_done)>& keep_going) {
  std::atomic<int> next_row{0}, rows_done{0};
  std::atomic<bool> stop{false};
  const auto work = [&](bool asks) {
    for (int row = next_row++; row < film.height && !stop; row = next_row++) {
      render_row(world, film, seed, row, begin, end);
      const int done = ++rows_done;
      if (asks && done < film.height && !keep_going(done)) stop = true;
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < std::min(threads, film.height); i++) pool.emplace_back(work, false);
  work(true);
  for (std::thread& thread : pool) thread.join();
  return rows_done == film.height;
}

}  // namespace

int render_samples(const CompiledScene& scene, Film& film, std::uint32_t seed, int begin, int end, int threads,
                   const std::function<bool(const Progress&)>& progress) {
  const World world(scene);
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); };
  const Clock::time_point start = Clock::now();
  const auto pixels = std::uint64_t(film.width) * std::uint64_t(film.height);
  const std::uint64_t total = pixels * std::uint64_t(end - begin);
  const auto report = [&](std::uint64_t samples) { return !progress || progress({samples, total, since(start)}); };
  // Passes grow while they are short, so that threads are worth starting and the answer to a stop is prompt.
  constexpr double kLongPass = 0.1;
  int done = begin, pass = 1;
  std::vector<std::int64_t> whole_passes;
  while (done < end) {
    const int next = std::min(end, done + pass);
    const std::uint64_t before = pixels * std::uint64_t(done - begin), row_samples = std::uint64_t(film.width) * std::uint64_t(next - done);
    whole_passes = film.words;
    const Clock::time_point pass_start = Clock::now();
    const bool finished =
        render_pass(world, film, seed, done, next, std::max(1, threads), [&](int rows) { return report(before + row_samples * std::uint64_t(rows)); });
    if (!finished) {
      film.words.swap(whole_passes);
      break;
    }
    done = next;
    if (!report(pixels * std::uint64_t(done - begin))) break;
    if (since(pass_start) < kLongPass) pass *= 2;
  }
  return done;
}

}  // namespace stokes::reference
