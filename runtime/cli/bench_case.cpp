// Timing, noise and parity of one scene.
#include "cli/bench_case.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/interrupt.h"
#include "cli/render_job.h"
#include "image/error.h"
#include "image/parity.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

double cpu_seconds() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A render of the samples [begin, end), or nothing when interrupted.
std::optional<FilmRecord> render(const LoadedScene& scene, Backend& backend, std::uint32_t seed, int begin, int end) {
  RenderJob job;
  job.backend = &backend;
  job.record.film = scene.empty_film(scene.whole());
  job.record.identity.seed = seed;
  job.record.sample_begin = job.record.sample_end = begin;
  job.sample_end = end;
  if (run_job(job) == RenderEnd::Interrupted) return std::nullopt;
  return std::move(job.record);
}

bool time_renders(const LoadedScene& scene, Backend& backend, int repeat, BenchResult& result) {
  std::vector<double> walls;
  for (int i = 0; i < repeat; i++) {
    const double cpu_before = cpu_seconds();
    const auto record = render(scene, backend, scene.compiled.seed + static_cast<std::uint32_t>(i), 0, scene.compiled.samples);
    if (!record) return false;
    result.cpu_runs.push_back(cpu_seconds() - cpu_before);
    walls.push_back(record->render_seconds);
    result.samples = static_cast<double>(film_totals(record->film).samples);
    result.counters = {record->rays, record->shadow_rays, record->scatterings, record->paths, film_totals(record->film).invalid};
    const Film& f = record->film;
    for (std::size_t c = 0; c < 3; c++)
      for (int y = 0; y < f.height; y++)
        for (int x = 0; x < f.width; x++)
          result.mean[c] += film_mean(f, x, y, static_cast<int>(c)) / (static_cast<double>(f.width) * f.height * repeat);
  }
  result.wall = median(walls);
  result.cpu = median(result.cpu_runs);
  return true;
}

/// Per pixel and of R, G, B and the luminance: sums over the parts.
struct Moments {
  double sum[4] = {}, squares[4] = {};
  void add(const double rgb[3]) {
    const double v[4] = {rgb[0], rgb[1], rgb[2], 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2]};
    for (int c = 0; c < 4; c++) sum[c] += v[c], squares[c] += v[c] * v[c];
  }
  /// The variance of a part over the squared mean; the hundredth keeps dark pixels from ruling.
  double relative(int c, int n) const {
    const double mean = sum[c] / n;
    return std::max(0.0, squares[c] / n - mean * mean) * n / (n - 1) / (mean * mean + 0.01);
  }
};

bool measure_noise(const LoadedScene& scene, Backend& backend, BenchResult& result) {
  const int parts = std::min(8, scene.compiled.samples), per_part = scene.compiled.samples / std::max(1, parts);
  if (parts < 2) return true;
  std::vector<Moments> pixels;
  for (int part = 0; part < parts; part++) {
    const auto record = render(scene, backend, scene.compiled.seed, part * per_part, (part + 1) * per_part);
    if (!record) return false;
    const Film& f = record->film;
    pixels.resize(static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height));
    for (int y = 0; y < f.height; y++)
      for (int x = 0; x < f.width; x++) {
        const double rgb[3] = {film_mean(f, x, y, 0), film_mean(f, x, y, 1), film_mean(f, x, y, 2)};
        pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(f.width) + static_cast<std::size_t>(x)].add(rgb);
      }
  }
  std::sort(pixels.begin(), pixels.end(), [&](const Moments& a, const Moments& b) { return a.relative(3, parts) < b.relative(3, parts); });
  const double count = static_cast<double>(pixels.size()), seconds = result.cpu * per_part / scene.compiled.samples;
  const double typical = pixels[pixels.size() / 2].relative(3, parts);
  pixels.resize(std::max<std::size_t>(1, pixels.size() - pixels.size() / 1000));
  double colours = 0;
  for (const Moments& m : pixels)
    for (int c = 0; c < 3; c++) colours += m.relative(c, parts) / (3 * static_cast<double>(pixels.size()));
  if (typical > 0) result.efficiency_median = count / (typical * seconds) * 1e-6;
  if (colours > 0) result.efficiency_rgb = count / (colours * seconds) * 1e-6;
  return true;
}

bool check_parity(const BenchCase& c, SceneOptions options, BenchResult& result) {
  options.size = c.parity_size;
  options.samples = c.parity_samples;
  std::vector<Estimate> estimates;
  for (const std::string& device : {options.device, std::string("reference")}) {
    options.device = device;
    const LoadedScene scene = load_scene(c.path, options, {}, {}, true);
    const auto backend = make_backend(scene.compiled, scene.device, {options.threads, options.kernel_dir});
    const auto record = render(scene, *backend, scene.compiled.seed, 0, scene.compiled.samples);
    if (!record) return false;
    estimates.push_back(estimate_of(record->film));
  }
  const ParityResult parity = test_parity(estimates[0], estimates[1], {.alpha = 0.001});
  result.parity = parity.agree;
  result.parity_z = std::abs(parity.worst.z);
  result.parity_threshold = parity.threshold;
  return true;
}

}  // namespace

std::vector<BenchCase> read_suite(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw InputError(path + (fs::exists(path, error) ? ": is no regular file" : ": there is no such file"));
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be opened");
  try {
    const nlohmann::json suite = nlohmann::json::parse(file);
    std::vector<BenchCase> cases;
    for (const nlohmann::json& entry : suite.at("scenes")) {
      BenchCase c;
      c.path = (fs::path(path).parent_path() / entry.at("file").get<std::string>()).string();
      c.name = entry.value("name", fs::path(c.path).stem().string());
      if (entry.contains("spp")) c.samples = entry.at("spp").get<int>();
      c.size = entry.value("size", c.size);
      if (entry.contains("parity")) {
        c.parity_size = entry.at("parity").value("size", c.parity_size);
        c.parity_samples = entry.at("parity").value("spp", c.parity_samples);
      }
      if (entry.contains("set"))
        for (const auto& [pointer, value] : entry.at("set").items()) c.settings.push_back(pointer + "=" + value.dump());
      cases.push_back(c);
    }
    return cases;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(path + ": is no suite: " + e.what());
  }
}

std::optional<BenchResult> run_case(const BenchCase& c, const SceneOptions& given, const BenchParts& parts) {
  SceneOptions options = given;
  options.settings.insert(options.settings.begin(), c.settings.begin(), c.settings.end());
  if (!options.samples) options.samples = c.samples;
  if (options.size.empty()) options.size = c.size;
  const LoadedScene scene = load_scene(c.path, options, {}, {}, true);
  const BackendOptions backend_options{options.threads, options.kernel_dir};
  BenchResult result;
  result.name = c.name;
  result.device = scene.device.name();
  result.driver = scene.device.driver();
  result.width = scene.whole().x1;
  result.height = scene.whole().y1;
  result.samples_per_pixel = scene.compiled.samples;
  result.load = scene.load_seconds;
  result.bvh = scene.compiled.bvh_seconds;

  // The caller sees to it that a cold build finds empty caches; the second build then is a warm one.
  if (parts.cold) result.build_cold = make_backend(scene.compiled, scene.device, backend_options)->build_seconds();
  const auto backend = make_backend(scene.compiled, scene.device, backend_options);
  result.build_warm = backend->build_seconds();

  if (!time_renders(scene, *backend, parts.repeat, result)) return std::nullopt;
  if (parts.noise && !measure_noise(scene, *backend, result)) return std::nullopt;
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  result.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  if (parts.parity && !check_parity(c, options, result)) return std::nullopt;
  return result;
}

}  // namespace stokes
