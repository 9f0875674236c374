// The parity test's own statistics: equal truths give uniform p-values and rarely reject; a bias of 1 % is caught.
#include "image/parity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "image/error.h"

namespace stokes {
namespace {

/// A synthetic render: exponentially distributed samples about a smooth truth, scaled by `bias` in the columns from `from` on.
Film noisy_film(std::uint64_t seed, int samples, double bias = 1, int from = 0) {
  Film film = make_film(32, 32, 0, 0, 32, 32, 0, 0, 0, 0, std::ldexp(1.0, -24), 1);
  std::mt19937_64 random(seed);
  std::exponential_distribution<double> noise(1.0);
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 32; x++)
      for (int s = 0; s < samples; s++) {
        const double truth = (0.5 + 0.01 * x) * (x >= from ? bias : 1);
        const double rgb[3] = {truth * noise(random), truth * noise(random), truth * noise(random)};
        film_add(film, x, y, rgb, 1, nullptr, nullptr);
      }
  return film;
}

TEST(Parity, NormalTailAndItsInverse) {
  EXPECT_NEAR(normal_tail(1.959964), 0.05, 1e-6);
  EXPECT_NEAR(normal_tail(-3.290527), 0.001, 1e-7);
  for (double p : {0.5, 1e-2, 1e-6, 1e-12}) EXPECT_NEAR(normal_tail(normal_quantile(p)) / p, 1, 1e-9);
}

TEST(Parity, PValuesOfEqualTruthsAreUniform) {
  // 150 pairs; Kolmogorov-Smirnov of the image-mean tests' p (three a pair, independent).
  std::vector<double> p;
  int rejected = 0;
  for (std::uint64_t i = 0; i < 150; i++) {
    const ParityResult r = test_parity(estimate_of(noisy_film(2 * i + 1, 16)), estimate_of(noisy_film(2 * i + 2, 16)));
    for (int c = 0; c < 3; c++) p.push_back(r.means[static_cast<std::size_t>(c)].p);
    rejected += !r.agree;
  }
  std::sort(p.begin(), p.end());
  double d = 0;
  for (std::size_t i = 0; i < p.size(); i++) {
    const double n = static_cast<double>(p.size()), k = static_cast<double>(i);
    d = std::max({d, std::fabs(p[i] - k / n), std::fabs(p[i] - (k + 1) / n)});
  }
  EXPECT_LT(d, 1.63 / std::sqrt(static_cast<double>(p.size()))) << "KS statistic, 1 % level";
  // At alpha = 0.01, 150 trials reject 1.5 times on average; more than 6 has probability 1e-3.
  EXPECT_LE(rejected, 6);
}

TEST(Parity, RareBrightSamplesAreNoDifference) {
  // One render finds its light evenly, the other in one sample of 2000: some eight a block, so that now and then a block finds none.
  int rejected = 0;
  for (std::uint64_t i = 0; i < 100; i++) {
    Film rare = make_film(32, 32, 0, 0, 32, 32, 0, 0, 0, 0, std::ldexp(1.0, -24), 1), even = rare;
    std::mt19937_64 random(1000 + i);
    std::bernoulli_distribution hit(5e-4);
    std::exponential_distribution<double> noise(1.0);
    for (int y = 0; y < 32; y++)
      for (int x = 0; x < 32; x++)
        for (int s = 0; s < 64; s++) {
          const double bright = hit(random) ? 2000 : 0, dim = noise(random);
          const double a[3] = {bright, bright, bright}, b[3] = {dim, dim, dim};
          film_add(rare, x, y, a, 1, nullptr, nullptr);
          film_add(even, x, y, b, 1, nullptr, nullptr);
        }
    rejected += !test_parity(estimate_of(rare), estimate_of(even)).agree;
  }
  // At alpha = 0.01, 100 trials reject once on average; more than 5 has probability 5e-4.
  EXPECT_LE(rejected, 5);
}

TEST(Parity, AOnePercentBiasIsCaught) {
  // A million samples of relative deviation 1 each: the difference of the means is known to 0.14 %.
  const ParityResult r = test_parity(estimate_of(noisy_film(1, 1024, 1.01)), estimate_of(noisy_film(2, 1024)));
  ASSERT_FALSE(r.agree);
  EXPECT_EQ(r.rejected.front().width, 0) << "the image mean sees it best";
}

TEST(Parity, ALocalBiasIsFoundWhereItIs) {
  const ParityResult r = test_parity(estimate_of(noisy_film(1, 64, 1.5, 28)), estimate_of(noisy_film(2, 64)));
  ASSERT_FALSE(r.agree);
  ParityTest first_block;
  for (const ParityTest& t : r.rejected)
    if (t.width > 0) {
      first_block = t;
      break;
    }
  EXPECT_GT(first_block.x + first_block.width, 28);
  EXPECT_LE(first_block.x, 28);
}

TEST(Parity, WithoutVarianceValuesMustBeEqualWithinRounding) {
  Film a = make_film(4, 4, 0, 0, 4, 4, 0, 0, 0, 0, std::ldexp(1.0, -30), 1), same = a, close = a, off = a;
  const auto fill = [](Film& film, double value) {
    const double rgb[3] = {value, value, value};
    for (int i = 0; i < 16; i++)
      for (int s = 0; s < 2; s++) film_add(film, i % 4, i / 4, rgb, 1, nullptr, nullptr);
  };
  fill(a, 1);
  fill(same, 1);
  fill(close, 1 + 1e-5);
  fill(off, 1 + 3e-4);
  EXPECT_TRUE(test_parity(estimate_of(a), estimate_of(same)).agree);
  EXPECT_TRUE(test_parity(estimate_of(a), estimate_of(close)).agree);
  EXPECT_FALSE(test_parity(estimate_of(a), estimate_of(off)).agree);
}

TEST(Parity, BlackAgainstLightIsADifference) {
  Film black = make_film(2, 2, 0, 0, 2, 2, 0, 0, 0, 0, 1e-9, 1), lit = black;
  const double zero[3] = {0, 0, 0}, one[3] = {1e-3, 0, 0};
  for (int i = 0; i < 4; i++) {
    film_add(black, i % 2, i / 2, zero, 1, nullptr, nullptr);
    film_add(lit, i % 2, i / 2, one, 1, nullptr, nullptr);
  }
  const ParityResult r = test_parity(estimate_of(black), estimate_of(lit));
  EXPECT_FALSE(r.agree);
  EXPECT_NE(describe(r).find("DIFFER"), std::string::npos);
}

TEST(Parity, ImagesNeedVariance) {
  Image image = develop(noisy_film(1, 4), true);
  EXPECT_NO_THROW(estimate_of(image));
  image = develop(noisy_film(1, 4), false);
  EXPECT_THROW(estimate_of(image), InputError);
}

}  // namespace
}  // namespace stokes
