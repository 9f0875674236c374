// Measuring truth cases. See truth_scenes.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "support/truth_scenes.h"

namespace stokes::tests {
namespace {

constexpr double kStandardErrors = 3, kTableAccuracy = 1e-4, kLargestRelativeError = 0.01;
// What single precision lets through at the rims of shapes, where nothing is to be seen beside a radiance of 1.
constexpr double kDark = 1e-8;

TruthResult measure(const Image& image, const Measurement& m) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<double> values(pixels, 0.0);
  for (const auto& [name, weight] : m.channels) {
    const Image::Channel* channel = image.find(name);
    if (!channel) throw std::runtime_error("the image has no channel " + name);
    for (std::size_t i = 0; i < pixels; i++) values[i] += weight * double(channel->values[i]);
  }
  double sum = 0, squares = 0;
  for (double v : values) sum += v;
  TruthResult r{m.label, m.expected, sum / double(pixels)};
  for (double v : values) squares += (v - r.mean) * (v - r.mean);
  r.standard_error = std::sqrt(squares / double(pixels - 1) / double(pixels));
  r.z = r.standard_error > 0 ? (r.mean - r.expected) / r.standard_error : 0;
  r.p = std::erfc(std::abs(r.z) / std::sqrt(2.0));
  return r;
}

}  // namespace

std::vector<TruthResult> run_truth_case(const TruthCase& c, const Backend& backend, std::uint32_t seed) {
  const Image image = backend(compile_scene(c.scene, c.options), c.samples, seed);
  std::vector<TruthResult> results;
  for (const Measurement& m : c.measurements) results.push_back(measure(image, m));
  return results;
}

namespace {

bool agrees(const TruthResult& r) {
  return std::abs(r.mean - r.expected) <= kStandardErrors * r.standard_error + (r.expected == 0 ? kDark : kTableAccuracy * std::abs(r.expected));
}

void print(const TruthCase& c, const TruthResult& r) {
  std::printf("%s %s: expected %.7g, got %.7g +- %.2g (z %.2f, threshold %.0f, p %.3g)\n", c.name.c_str(), r.label.c_str(), r.expected, r.mean,
              r.standard_error, r.z, kStandardErrors, r.p);
}

}  // namespace

// Among hundreds of measurements one in 370 lies beyond three standard errors by chance. One that does is measured again with four times
// the samples and another seed, and that is final: a real bias grows to twice as many standard errors, chance does not come twice.
void check_truth_case(const TruthCase& c, const Backend& backend, std::uint32_t seed) {
  std::vector<TruthResult> results = run_truth_case(c, backend, seed);
  for (const TruthResult& r : results) print(c, r);
  if (!std::all_of(results.begin(), results.end(), agrees)) {
    TruthCase again = c;
    again.samples *= 4;
    std::printf("%s: again, with %d samples\n", c.name.c_str(), again.samples);
    results = run_truth_case(again, backend, seed + 1000003u);
    for (const TruthResult& r : results) print(c, r);
  }
  for (const TruthResult& r : results) {
    EXPECT_TRUE(agrees(r)) << c.name << " " << r.label << " (" << c.source << "): expected " << r.expected << ", got " << r.mean << " +- "
                           << r.standard_error << ", p " << r.p;
    if (r.expected != 0) {
      EXPECT_LE(r.standard_error, kLargestRelativeError * std::abs(r.expected)) << c.name << ": too noisy to say anything";
    }
  }
}

}  // namespace stokes::tests
