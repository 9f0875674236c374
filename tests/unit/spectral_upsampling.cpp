// Colours made into spectra: the round trip, the range, what lies below 380 nm, and colours brighter than 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spectral/tabulate.h"

namespace stokes {
namespace {

double largest_difference(Vec3d a, Vec3d b) { return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}); }

// As the kernels evaluate a texel, in float.
SpectrumTable float_table(const std::array<float, 3>& c) {
  SpectrumTable t;
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    const float l = std::max(380.0f, 280.0f + i / 2 + i % 2), s = (l - 280) / 500, x = (c[0] * s + c[1]) * s + c[2];
    t[i] = 0.5f + x / (2 * std::sqrt(1 + x * x));
  }
  return t;
}

TEST(Upsampling, RoundTripOverTheCube) {
  constexpr int n = 10;
  for (int r = 0; r <= n; r++)
    for (int g = 0; g <= n; g++)
      for (int b = 0; b <= n; b++) {
        const Vec3d rgb = Vec3d{double(r), double(g), double(b)} / n;
        const SpectrumTable t = float_table(fit_sigmoid(rgb));
        ASSERT_LE(largest_difference(xyz_to_rgb(reflectance_xyz(t)), rgb), 1e-4) << rgb.x << " " << rgb.y << " " << rgb.z;
        for (const float v : t) ASSERT_TRUE(v >= 0 && v <= 1) << v;
      }
}

TEST(Upsampling, RoundTripOfDarkAndNearlyExtremeColours) {
  for (const Vec3d rgb : {Vec3d{1e-3, 0, 0}, Vec3d{0, 0, 1e-3}, Vec3d{0, 1e-4, 0}, Vec3d{0.999, 1, 1}, Vec3d{1, 1, 0.999}, Vec3d{1, 0.001, 0},
                          Vec3d{0.0001, 1, 0.0002}, Vec3d{1e-5, 1e-5, 1}, Vec3d{0.5, 0.5, 0.500001}})
    EXPECT_LE(largest_difference(xyz_to_rgb(reflectance_xyz(float_table(fit_sigmoid(rgb)))), rgb), 1e-4)
        << rgb.x << " " << rgb.y << " " << rgb.z;
}

TEST(Upsampling, GreysAreConstantAndTheEndsExact) {
  for (const double v : {0.0, 0.18, 0.5, 1.0}) {
    const std::array<float, 3> c = fit_sigmoid({v, v, v});
    EXPECT_EQ(c[0], 0);
    EXPECT_EQ(c[1], 0);
    for (const float value : float_table(c)) EXPECT_NEAR(value, v, 1e-7);
  }
}

TEST(Upsampling, ComponentsOutsideAreClamped) { EXPECT_EQ(fit_sigmoid({2, -1, 0.5}), fit_sigmoid({1, 0, 0.5})); }

TEST(Upsampling, HoldsBelow380UnlessToldOtherwise) {
  Spectrum s;
  s.kind = SpectrumKind::Rgb;
  s.rgb = {0.8, 0.1, 0.1};
  const double held = evaluate(s, SpectrumRole::Reflectance, 380);
  for (const double l : {280.0, 333.3, 379.9}) EXPECT_EQ(evaluate(s, SpectrumRole::Reflectance, l), held) << l;
  EXPECT_NE(evaluate(s, SpectrumRole::Reflectance, 385), held);
  EXPECT_EQ(sigmoid_value(fit_sigmoid(s.rgb), 300), sigmoid_value(fit_sigmoid(s.rgb), 380));
  s.uv = 0.05;
  const SpectrumTable t = tabulate(s, SpectrumRole::Reflectance);
  EXPECT_EQ(t[2 * 99 + 1], 0.05f);  // up to 380 nm from the left
  EXPECT_FLOAT_EQ(t[2 * 100], float(held));
  EXPECT_EQ(t[0], 0.05f);
}

TEST(Upsampling, CoefficientsMayExceedOneOrBeNegative) {
  Spectrum s;
  s.kind = SpectrumKind::Rgb;
  for (const Vec3d rgb : {Vec3d{5, 1, 20}, Vec3d{0.5, 0, -0.5}, Vec3d{-0.9, -0.9, 0.9}}) {
    s.rgb = rgb;
    const double scale = std::max({1.0, rgb.x, rgb.y, rgb.z});
    EXPECT_LE(largest_difference(xyz_to_rgb(reflectance_xyz(tabulate(s, SpectrumRole::Coefficient))), rgb), 1e-4 * scale);
  }
  s.rgb = {3, 3, 3};
  const SpectrumTable grey = tabulate(s, SpectrumRole::Coefficient);
  EXPECT_TRUE(is_constant(grey));
  EXPECT_NEAR(grey[0], 3, 1e-6);
}

}  // namespace
}  // namespace stokes
