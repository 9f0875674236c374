// Differences of images with known answers.
#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "image/error.h"
#include "image/flip.h"

namespace stokes {
namespace {

Image flat(int width, int height, float r, float g, float b) {
  Image image;
  image.width = width;
  image.height = height;
  const std::size_t n = static_cast<std::size_t>(width * height);
  image.channels = {{"R", std::vector<float>(n, r)}, {"G", std::vector<float>(n, g)}, {"B", std::vector<float>(n, b)}};
  return image;
}

TEST(Compare, SquaredErrorsOfFlatImages) {
  const ImageDifference d = compare_images(flat(4, 3, 0.6f, 0.5f, 0.5f), flat(4, 3, 0.5f, 0.5f, 0.5f));
  EXPECT_NEAR(d.mse, 0.01 / 3, 1e-8);
  EXPECT_NEAR(d.relative_mse, 0.01 / 0.26 / 3, 1e-7);
  EXPECT_NEAR(d.largest, 0.1, 1e-7);
  EXPECT_FALSE(d.identical);
  EXPECT_NEAR(d.mean_a[0], 0.6, 1e-6);
}

TEST(Compare, AnImageEqualsItself) {
  const Image image = flat(9, 9, 0.2f, 0.9f, 0.1f);
  const ImageDifference d = compare_images(image, image);
  EXPECT_TRUE(d.identical);
  EXPECT_EQ(d.mse, 0);
  EXPECT_EQ(d.flip, 0);
}

TEST(Compare, NotFiniteValuesAreCounted) {
  Image image = flat(2, 2, 1, 1, 1);
  image.channels[1].values[3] = NAN;
  const ImageDifference d = compare_images(image, flat(2, 2, 1, 1, 1));
  EXPECT_EQ(d.not_finite, 1u);
  EXPECT_EQ(d.mean_a[1], 1) << "the mean is that of the values that count";
}

TEST(Compare, SizesMustMatch) { EXPECT_THROW(compare_images(flat(2, 2, 1, 1, 1), flat(2, 3, 1, 1, 1)), InputError); }

// Without structure FLIP is the redistributed colour difference alone: green against blue is its definition of 1.
TEST(Flip, GreenAgainstBlueIsOne) { EXPECT_NEAR(flip_difference(flat(8, 8, 0, 1, 0), flat(8, 8, 0, 0, 1)), 1, 1e-7); }

TEST(Flip, BlackAgainstWhite) {
  // HyAB of black and white is 100, of green and blue 308.1 with the Hunt effect: (100^0.7 / (0.4 * 308.1^0.7)) * 0.95 where below the knee, else
  // above it. Computed here from the paper's formulas independently of the code's planes.
  const auto curve = [](double t) { return std::cbrt(t); };
  const auto hunt = [&](double x, double y, double z, double out[3]) {
    out[0] = 116 * curve(y) - 16;
    out[1] = 5 * out[0] * (curve(x) - curve(y));
    out[2] = 2 * out[0] * (curve(y) - curve(z));
  };
  double g[3], b[3];
  hunt(8788810 / 24577794.0 / 0.950428545, 8788810 / 12288897.0, 8788810 / 73733382.0 / 1.088900371, g);
  hunt(4435075 / 24577794.0 / 0.950428545, 887015 / 12288897.0, 70074185 / 73733382.0 / 1.088900371, b);
  const double largest = std::pow(std::fabs(g[0] - b[0]) + std::hypot(g[1] - b[1], g[2] - b[2]), 0.7), error = std::pow(100.0, 0.7);
  const double knee = 0.4 * largest;
  const double expected = error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (largest - knee);
  EXPECT_NEAR(flip_difference(flat(8, 8, 0, 0, 0), flat(8, 8, 1, 1, 1)), expected, 1e-7);
}

TEST(Flip, StructureCountsAndSmallNoiseHardly) {
  Image a = flat(48, 48, 0.5f, 0.5f, 0.5f), lines = a, faint = a;
  for (std::size_t i = 0; i < 48 * 48; i++)
    for (std::size_t c = 0; c < 3; c++) {
      lines.channels[c].values[i] = i % 12 == 0 ? 1.0f : 0.46f;
      faint.channels[c].values[i] = i % 2 ? 0.501f : 0.499f;
    }
  EXPECT_GT(flip_difference(a, lines), 0.1);
  EXPECT_LT(flip_difference(a, faint), 0.03);
}

/// The picture of the fixture's pairs: smooth, with values in [0, 1].
Image ramps() {
  Image image = flat(64, 48, 0, 0, 0);
  for (int y = 0; y < 48; y++)
    for (int x = 0; x < 64; x++) {
      const auto i = static_cast<std::size_t>(y * 64 + x);
      image.channels[0].values[i] = static_cast<float>(x / 63.0);
      image.channels[1].values[i] = static_cast<float>(y / 47.0);
      image.channels[2].values[i] = static_cast<float>((x + y) / 110.0);
    }
  return image;
}

// Values of the FLIP authors' own program (PyPI flip-evaluator 1.7) by make_flip_values.py, which has the same images.
TEST(Flip, AgreesWithItsAuthorsProgram) {
  const Image a = ramps();
  Image dim = a, block = a, stripe = a, patterned = a;
  for (int y = 0; y < 48; y++)
    for (int x = 0; x < 64; x++)
      for (std::size_t c = 0; c < 3; c++) {
        const auto i = static_cast<std::size_t>(y * 64 + x);
        const float v = a.channels[c].values[i];
        dim.channels[c].values[i] = 0.9f * v + 0.02f;
        if (x >= 30 && x < 45 && y >= 10 && y < 20) block.channels[c].values[i] = 1 - v;
        if (x == 31) stripe.channels[c].values[i] = 0;
        const double pattern[3] = {((5 * x + 3 * y) % 32) / 31.0, ((x * x + y) % 29) / 28.0, ((x ^ y) % 17) / 16.0};
        patterned.channels[c].values[i] = static_cast<float>(pattern[c]);
      }
  struct Pair {
    const char* name;
    const Image* test;
    double at_67, at_30;
  };
  for (const Pair& pair : {Pair{"dim", &dim, 0.1655937, 0.1576298}, Pair{"block", &block, 0.0633852, 0.0508460},
                           Pair{"stripe", &stripe, 0.0333646, 0.0285048}, Pair{"patterned", &patterned, 0.7451314, 0.8244901}}) {
    const double ours_67 = flip_difference(a, *pair.test, 67), ours_30 = flip_difference(a, *pair.test, 30);
    std::printf("%s: %.7f and %.7f, off by %.1e and %.1e\n", pair.name, ours_67, ours_30, ours_67 - pair.at_67, ours_30 - pair.at_30);
    EXPECT_NEAR(ours_67, pair.at_67, 5e-7) << pair.name;
    EXPECT_NEAR(ours_30, pair.at_30, 5e-7) << pair.name;
  }
}

}  // namespace
}  // namespace stokes
