// The colour of skin under D65 against published-formula figures: two layers, n 1.4, g 0.8, blood 0.01 at saturation 0.75, epidermis 0.06 mm.
//
// The figures are diffuse reflectances: lit and seen from all sides, the surface's own reflection included. A pixel under a uniform background
// is, by reciprocity, the reflectance for light from its direction; the mean over directions is a Gauss-Legendre sum over the squared cosine
// of what comes out of the skin, plus the closed form of what never went in. (Along the normal alone level 0.02 is seven codes darker.)
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "scene/read_scene.h"
#include "support/backends.h"

namespace stokes::tests {
namespace {

constexpr double kIor = 1.4;

struct Level {
  const char* melanosomes;
  int samples;
  double srgb[3];
};
// Worked out from Jacques 1998 and 2013 and Prahl's haemoglobin (runtime/spectral/skin.h).
constexpr Level kLevels[] = {{"0.02", 1000, {188, 157, 136}}, {"0.10", 1000, {151, 119, 97}}, {"0.25", 1000, {117, 93, 82}}, {"0.43", 1000, {97, 83, 80}}};

double fresnel(double mu) {
  const double s = std::sqrt(1 - mu * mu) / kIor, c = std::sqrt(1 - s * s);
  const double a = (mu - kIor * c) / (mu + kIor * c), b = (kIor * mu - c) / (kIor * mu + c);
  return (a * a + b * b) / 2;
}

double mean_fresnel() {
  double sum = 0;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; i++) {
    const double mu = (i + 0.5) / kSteps;
    sum += 2 * mu * fresnel(mu) / kSteps;
  }
  return sum;
}

double srgb_code(double x) { return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055); }

Image seen_at(const Level& level, double mu, const std::string& seed) {
  const double s = std::sqrt(1 - mu * mu);
  const std::string text = R"({"scene unit": "mm", "camera": {"type": "orthographic", "height": 1, "resolution": [16, 16], "transform": {"from": [)" +
                           std::to_string(10 * s) + ", 0, " + std::to_string(10 * mu) + R"(], "at": [0, 0, 0], "up": [0, 1, 0]}},
    "integrator": {"type": "path tracer volumetric mats", "max bounces": 100000}, "background": 1,
    "surfaces": [{"type": "quad", "size": 400, "material": {"type": "skin", "blood fraction": 0.01, "melanosome fraction": )" + level.melanosomes +
                           "}}]}";
  return opencl_backend(compile_scene(read_scene_text(text, "skin.json", ".")), level.samples, seed_of(seed));
}

class SkinColour : public testing::TestWithParam<Level> {};

TEST_P(SkinColour, UnderD65) {
  const Level& level = GetParam();
  double mean[3], variance[3] = {};
  std::fill(mean, mean + 3, mean_fresnel());
  const double offset = std::sqrt(0.15), squares[] = {0.5 - offset, 0.5, 0.5 + offset}, weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (int i = 0; i < 3; i++) {
    const double mu = std::sqrt(squares[i]);
    const Image image = seen_at(level, mu, std::string("skin ") + level.melanosomes + std::to_string(i));
    for (int c = 0; c < 3; c++) {
      const std::vector<float>& values = image.find(std::string(1, "RGB"[c]))->values;
      const double n = static_cast<double>(values.size());
      double sum = 0, of_squares = 0;
      for (const float v : values) sum += v, of_squares += double(v) * double(v);
      mean[c] += weights[i] * (sum / n - fresnel(mu));
      variance[c] += weights[i] * weights[i] * (of_squares / n - sum * sum / n / n) / n;
    }
  }
  for (int c = 0; c < 3; c++) {
    const double code = srgb_code(mean[c]), error = srgb_code(mean[c] + std::sqrt(variance[c])) - code;
    std::printf("melanosomes %s %c: expected %.0f, got %.1f +- %.2f\n", level.melanosomes, "RGB"[c], level.srgb[c], code, error);
    EXPECT_LE(std::abs(code - level.srgb[c]), 1.5 + 3 * error) << "RGB"[c];  // figures are whole codes, quadrature is three points
    EXPECT_LE(error, 0.3) << "too noisy to say anything";
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, SkinColour, testing::ValuesIn(kLevels),
                         [](const auto& info) { return "Melanosomes" + std::string(info.param.melanosomes + 2); });

}  // namespace
}  // namespace stokes::tests
