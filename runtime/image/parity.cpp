// Do two renders agree? Tests of pixel blocks and whole-image means against their own variances. Knows films and images, not how
// they were rendered.
#include "image/parity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "image/error.h"

namespace stokes {
namespace {

/// Sums over a rectangle of one channel of both estimates.
struct Sums {
  double mean_a = 0, mean_b = 0, variance_a = 0, variance_b = 0, magnitude = 0;
  double count = 0;
};

Sums sum_block(const Estimate::Channel& a, const Estimate::Channel& b, int stride, int x0, int y0, int x1, int y1) {
  Sums s;
  for (int y = y0; y < y1; y++)
    for (int x = x0; x < x1; x++) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
      s.mean_a += a.mean[i];
      s.mean_b += b.mean[i];
      s.variance_a += a.variance[i];
      s.variance_b += b.variance[i];
      s.magnitude += std::max(std::fabs(a.mean[i]), std::fabs(b.mean[i]));
      s.count++;
    }
  return s;
}

/// The blocks of one channel, row by row.
struct BlockGrid {
  int columns = 0, rows = 0;
  std::vector<Sums> blocks;
};

BlockGrid sum_blocks(const Estimate& a, const Estimate& b, std::size_t channel, int block) {
  BlockGrid grid;
  grid.columns = (a.width + block - 1) / block;
  grid.rows = (a.height + block - 1) / block;
  for (int y = 0; y < a.height; y += block)
    for (int x = 0; x < a.width; x += block)
      grid.blocks.push_back(
          sum_block(a.channels[channel], b.channels[channel], a.width, x, y, std::min(a.width, x + block), std::min(a.height, y + block)));
  return grid;
}

/// A block's sums, with its variances raised to its neighbourhood's (3 x 3 blocks) where that is more.
///
/// Where light is found by rare samples, a block that happened to miss them has too small a mean and sees too small a variance: each
/// render alone would vouch for its own mistake. The neighbours have not missed them too.
Sums with_neighbours(const BlockGrid& grid, int column, int row) {
  double variance_a = 0, variance_b = 0, count = 0;
  for (int r = std::max(0, row - 1); r <= std::min(grid.rows - 1, row + 1); r++)
    for (int c = std::max(0, column - 1); c <= std::min(grid.columns - 1, column + 1); c++) {
      const Sums& s = grid.blocks[static_cast<std::size_t>(r * grid.columns + c)];
      variance_a += s.variance_a;
      variance_b += s.variance_b;
      count += s.count;
    }
  Sums s = grid.blocks[static_cast<std::size_t>(row * grid.columns + column)];
  s.variance_a = std::max(s.variance_a, variance_a * s.count / count);
  s.variance_b = std::max(s.variance_b, variance_b * s.count / count);
  return s;
}

/// z of a difference of sums; rounding counts as a further, tiny deviation, which also settles zero variances.
ParityTest make_test(const std::string& channel, const Sums& s, double tolerance) {
  ParityTest t;
  t.channel = channel;
  t.mean_a = s.mean_a / s.count;
  t.mean_b = s.mean_b / s.count;
  const double rounding = tolerance * s.magnitude / s.count + 1e-12;
  t.sigma = std::sqrt((s.variance_a + s.variance_b) / (s.count * s.count) + rounding * rounding);
  t.z = (t.mean_a - t.mean_b) / t.sigma;
  if (!std::isfinite(t.z)) t.z = HUGE_VAL;
  t.p = normal_tail(t.z);
  return t;
}

/// Some thousand samples a block make its mean nearly normal, even where single samples are far from it.
int block_for(double samples_per_pixel) {
  int block = 1;
  while (block < 32 && block * block * std::max(1.0, samples_per_pixel) < 4096) block *= 2;
  return block;
}

void require_alike(const Estimate& a, const Estimate& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError("the images have different sizes: " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
                     std::to_string(b.width) + "x" + std::to_string(b.height));
  if (a.channels.size() != b.channels.size()) throw InputError("the images have different channels");
}

}  // namespace

double normal_tail(double z) { return std::erfc(std::fabs(z) / std::numbers::sqrt2); }

double normal_quantile(double two_sided_p) {
  double low = 0, high = 40;
  for (int i = 0; i < 200; i++) {
    const double middle = 0.5 * (low + high);
    (normal_tail(middle) > two_sided_p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate estimate_of(const Film& film) {
  Estimate e;
  e.width = film.width;
  e.height = film.height;
  e.x = film.crop_x;
  e.y = film.crop_y;
  const char* names[4] = {"R", "G", "B", "A"};
  for (int c = 0; c < 4; c++) {
    Estimate::Channel channel{names[c], {}, {}};
    for (int y = 0; y < film.height; y++)
      for (int x = 0; x < film.width; x++) {
        const double mean = film_mean(film, x, y, c), n = static_cast<double>(film_pixel(film, x, y)[10]);
        channel.mean.push_back(mean);
        channel.variance.push_back(c < 3 ? film_variance(film, x, y, c) : std::max(0.0, mean * (1 - mean)) / std::max(1.0, n));
      }
    e.channels.push_back(std::move(channel));
  }
  const double pixels = static_cast<double>(film.width) * film.height;
  e.samples_per_pixel = pixels > 0 ? static_cast<double>(film_totals(film).samples) / pixels : 0;
  return e;
}

Estimate estimate_of(const Image& image) {
  Estimate e;
  e.width = image.width;
  e.height = image.height;
  e.x = image.x;
  e.y = image.y;
  for (const char* name : {"R", "G", "B"}) {
    const Image::Channel *mean = image.find(name), *variance = image.find(std::string("Variance.") + name);
    if (!mean || !variance) throw InputError(std::string("the image has no channel ") + (mean ? "Variance." : "") + name);
    e.channels.push_back({name, {mean->values.begin(), mean->values.end()}, {variance->values.begin(), variance->values.end()}});
  }
  for (const auto& [key, value] : image.metadata)
    if (key == "stokes:samples") e.samples_per_pixel = std::atof(value.c_str());
  return e;
}

ParityResult test_parity(const Estimate& a, const Estimate& b, const ParityOptions& options) {
  require_alike(a, b);
  ParityResult result;
  result.block = options.block > 0 ? options.block : block_for(std::min(a.samples_per_pixel, b.samples_per_pixel));
  std::vector<ParityTest> tests;
  for (std::size_t c = 0; c < a.channels.size(); c++) {
    const std::string& name = a.channels[c].name;
    const BlockGrid grid = sum_blocks(a, b, c, result.block);
    for (int row = 0; row < grid.rows; row++)
      for (int column = 0; column < grid.columns; column++) {
        const int x = column * result.block, y = row * result.block;
        ParityTest test = make_test(name, with_neighbours(grid, column, row), options.tolerance);
        test.x = a.x + x;
        test.y = a.y + y;
        test.width = std::min(a.width, x + result.block) - x;
        test.height = std::min(a.height, y + result.block) - y;
        tests.push_back(test);
      }
    result.means.push_back(make_test(name, sum_block(a.channels[c], b.channels[c], a.width, 0, 0, a.width, a.height), options.tolerance));
    tests.push_back(result.means.back());
  }
  // Sidak: of T tests at level 1 - (1 - alpha)^(1/T), at least one rejects equal images with probability alpha.
  result.tests = tests.size();
  const double count = static_cast<double>(std::max<std::size_t>(1, tests.size()));
  result.threshold = normal_quantile(-std::expm1(std::log1p(-options.alpha) / count));
  std::sort(tests.begin(), tests.end(), [](const ParityTest& l, const ParityTest& r) { return std::fabs(l.z) > std::fabs(r.z); });
  for (const ParityTest& test : tests)
    if (std::fabs(test.z) > result.threshold) result.rejected.push_back(test);
  if (!tests.empty()) {
    result.worst = tests.front();
    result.p = result.worst.p < 1 ? -std::expm1(count * std::log1p(-result.worst.p)) : 1;
  }
  result.agree = result.rejected.empty();
  return result;
}

std::string describe(const ParityResult& result) {
  char line[256];
  std::string text;
  std::snprintf(line, sizeof line, "%s: %zu tests (blocks of %dx%d pixels and image means), largest |z| %.2f, threshold %.2f, p = %.3g\n",
                result.agree ? "agree" : "DIFFER", result.tests, result.block, result.block, std::fabs(result.worst.z), result.threshold,
                result.p);
  text += line;
  for (const ParityTest& t : result.means) {
    const double scale = std::max(std::fabs(t.mean_b), 1e-30);
    std::snprintf(line, sizeof line, "  mean %s: %.6g and %.6g (%+.3f %% +- %.3f %%, z = %+.2f)\n", t.channel.c_str(), t.mean_a, t.mean_b,
                  100 * (t.mean_a - t.mean_b) / scale, 100 * t.sigma / scale, t.z);
    text += line;
  }
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, result.rejected.size()); i++) {
    const ParityTest& t = result.rejected[i];
    if (t.width == 0)
      std::snprintf(line, sizeof line, "  parts in the mean of %s: z = %+.2f\n", t.channel.c_str(), t.z);
    else
      std::snprintf(line, sizeof line, "  parts at pixels [%d,%d) x [%d,%d), %s: %.6g and %.6g, z = %+.2f\n", t.x, t.x + t.width, t.y,
                    t.y + t.height, t.channel.c_str(), t.mean_a, t.mean_b, t.z);
    text += line;
  }
  if (result.rejected.size() > kShown) text += "  ... and " + std::to_string(result.rejected.size() - kShown) + " more\n";
  return text;
}

}  // namespace stokes
