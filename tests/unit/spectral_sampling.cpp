// Wavelengths drawn from tables and from the camera's density: chi-square, coverage, and what the estimators add up to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spectral/tabulate.h"
#include "layout.h"

namespace stokes {
namespace {

// Stratified uniforms would hide a wrong shape, so these are pseudo-random (SplitMix64).
struct Uniform {
  std::uint64_t state = 12345;
  double operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

SpectrumTable test_table() {
  // A triangle steep enough to show inside a cell, a gap, a box, and a negative part that counts as 0.
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  s.wavelengths = {300, 303, 306, 500, 501, 600, 601, 700};
  s.values = {0, 6, 0, 0, 0.05, 0.05, -1, -1};
  return tabulate(s, SpectrumRole::Dye);
}

TEST(Distribution, CumulativeTable) {
  const SpectrumTable t = test_table();
  const TableDistribution d = make_distribution(t);
  EXPECT_EQ(d.cdf.front(), 0);
  EXPECT_EQ(d.cdf.back(), 1);
  for (int i = 0; i < kSpectrumCells; i++) EXPECT_LE(d.cdf[i], d.cdf[i + 1]);
  EXPECT_NEAR(d.integral, 18 + 0.025 + 4.95 + 0.025, 1e-5);
  EXPECT_EQ(make_distribution(SpectrumTable{}).integral, 0);
}

TEST(Distribution, SamplesFollowTheDensity) {
  const SpectrumTable t = test_table();
  const TableDistribution d = make_distribution(t);
  // Quarters of the first six cells (the density is not even there), then the box in five parts.
  std::vector<double> edges;
  for (int i = 0; i <= 24; i++) edges.push_back(300 + i / 4.0);
  for (int i = 0; i <= 5; i++) edges.push_back(500 + 20.0 * i + (i == 5));
  std::vector<double> count(edges.size() - 1);
  Uniform uniform;
  constexpr int n = 400000;
  for (int i = 0; i < n; i++) {
    const double l = sample_distribution(t, d, uniform());
    const int bin = int(std::upper_bound(edges.begin(), edges.end(), l) - edges.begin()) - 1;
    ASSERT_TRUE(bin >= 0 && bin < int(count.size())) << l;
    count[bin]++;
  }
  double statistic = 0;
  int degrees = -1;
  for (std::size_t i = 0; i < count.size(); i++) {
    // Negative parts count as 0: the last cell falls from 0.05 to 0.
    double expected = table_integral(t, edges[i], std::min(edges[i + 1], 600.0));
    if (edges[i + 1] > 600) expected += 0.025;
    expected *= n / d.integral;
    if (expected < 1e-6) {
      EXPECT_EQ(count[i], 0) << edges[i];
      continue;
    }
    statistic += (count[i] - expected) * (count[i] - expected) / expected;
    degrees++;
  }
  // Wilson and Hilferty: the 0.9999 quantile.
  const double v = 2.0 / (9 * degrees), threshold = degrees * std::pow(1 - v + 3.719 * std::sqrt(v), 3);
  EXPECT_LT(statistic, threshold) << degrees << " degrees of freedom";
}

TEST(Distribution, TheEndsOfTheUnitInterval) {
  const SpectrumTable t = test_table();
  const TableDistribution d = make_distribution(t);
  EXPECT_NEAR(sample_distribution(t, d, 0), 300, 1e-9);
  const double last = sample_distribution(t, d, 1 - 0x1p-53);
  EXPECT_TRUE(last > 600 && last <= 601) << last;
}

// Camera knots: every visible wavelength can be drawn, and the estimator with 1/pdf from the knots adds up to the pixel.
class Knots : public testing::TestWithParam<std::tuple<int, double, double>> {};

TEST_P(Knots, IncreaseAndCoverTheFilmAndTheBins) {
  const auto [bins, begin, end] = GetParam();
  const std::vector<float> knots = camera_knots(STOKES_CAMERA_KNOTS, bins, begin, end);
  ASSERT_EQ(knots.size(), STOKES_CAMERA_KNOTS + 1u);
  for (int i = 0; i < STOKES_CAMERA_KNOTS; i++) ASSERT_LT(knots[i], knots[i + 1]) << i;
  EXPECT_FLOAT_EQ(knots.front(), bins > 0 ? std::min(360.0, begin) : 360.0);
  EXPECT_FLOAT_EQ(knots.back(), 780);
}

TEST_P(Knots, TheEstimatorIsUnbiased) {
  const auto [bins, begin, end] = GetParam();
  const std::vector<float> knots = camera_knots(STOKES_CAMERA_KNOTS, bins, begin, end), sensor = sensor_table();
  constexpr int inner = 64;
  double rgb[3] = {}, mass = 0;
  for (int i = 0; i < STOKES_CAMERA_KNOTS; i++)
    for (int j = 0; j < inner; j++) {
      const double width = double(knots[i + 1]) - knots[i], l = knots[i] + (j + 0.5) / inner * width;
      const double inverse_pdf = STOKES_CAMERA_KNOTS * width;
      const int c = std::min(int(l - 280), 499);
      for (int k = 0; k < 3; k++) {
        const double s = sensor[8 * c + k] + (l - 280 - c) * (sensor[8 * c + 4 + k] - sensor[8 * c + k]);
        rgb[k] += s * d65(l) * inverse_pdf / (STOKES_CAMERA_KNOTS * inner);
      }
      mass += inverse_pdf / (STOKES_CAMERA_KNOTS * inner);
    }
  for (int k = 0; k < 3; k++) EXPECT_NEAR(rgb[k], 1, 1e-4) << k;
  EXPECT_NEAR(mass, knots.back() - knots.front(), 1e-3);
}

// Beside the even share and the bins, the density is the norm of the sensor's three values.
TEST_P(Knots, DensityFollowsTheSensor) {
  const auto [bins, begin, end] = GetParam();
  const std::vector<float> knots = camera_knots(STOKES_CAMERA_KNOTS, bins, begin, end), sensor = sensor_table();
  // Fraction of the samples below l, by the knots.
  const auto fraction = [&](double l) {
    const auto above = std::upper_bound(knots.begin(), knots.end(), float(l));
    if (above == knots.begin()) return 0.0;
    if (above == knots.end()) return 1.0;
    const double i = double(above - knots.begin()) - 1;
    return (i + (l - *(above - 1)) / (double(*above) - *(above - 1))) / STOKES_CAMERA_KNOTS;
  };
  double norm_sum = 0, norm[501] = {};
  for (int c = 0; c < 500; c++) norm_sum += norm[c] = std::hypot(sensor[8 * c], sensor[8 * c + 1], sensor[8 * c + 2]);
  for (int l = 300; l < 780; l += 20) {
    double expected = 0;
    for (int c = l - 280; c < l - 260; c++) expected += norm[c] / norm_sum * (31.0 / 32);
    if (l >= 360) expected += 20.0 / 420 / 32;
    if (bins > 0) expected = expected / 2 + std::max(0.0, std::min(l + 20.0, end) - std::max(double(l), begin)) / (end - begin) / 2;
    EXPECT_NEAR(fraction(l + 20) - fraction(l), expected, 3e-3) << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Ranges, Knots,
                         testing::Values(std::tuple{0, 0.0, 0.0}, std::tuple{50, 280.0, 780.0}, std::tuple{8, 300.0, 340.0},
                                         std::tuple{4, 500.0, 520.0}, std::tuple{16, 360.5, 780.0}));

// The density exists to lower the noise: for a flat spectrum the summed variance of one sample is under half of the uniform one's.
TEST(CameraKnots, LessColourNoiseThanUniform) {
  const std::vector<float> knots = camera_knots(STOKES_CAMERA_KNOTS, 0, 0, 0), sensor = sensor_table();
  const auto square = [&](double l) {
    const int c = std::min(int(l - 280), 499);
    return double(sensor[8 * c]) * sensor[8 * c] + double(sensor[8 * c + 1]) * sensor[8 * c + 1] + double(sensor[8 * c + 2]) * sensor[8 * c + 2];
  };
  double ours = 0, uniform = 0;
  for (int i = 0; i < STOKES_CAMERA_KNOTS; i++) {
    const double width = double(knots[i + 1]) - knots[i];
    ours += square(knots[i] + width / 2) * width * width * STOKES_CAMERA_KNOTS;
    uniform += square(knots[i] + width / 2) * width * 420;
  }
  const double mean_square = 1.20506 * 1.20506 + 0.94822 * 0.94822 + 0.90898 * 0.90898;
  EXPECT_LT(ours - mean_square, 0.6 * (uniform - mean_square)) << ours << " " << uniform;
}

}  // namespace
}  // namespace stokes
