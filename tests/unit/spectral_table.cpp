// Tables of 1 nm cells: each form's values, edges inside and between cells, integrals, extrapolation.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "spectral/tabulate.h"

namespace stokes {
namespace {

Spectrum box(double value, double a, double b) {
  Spectrum s;
  s.kind = SpectrumKind::Box;
  s.value = value, s.a = a, s.b = b;
  return s;
}

Spectrum sampled(std::vector<double> wavelengths, std::vector<double> values) {
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  s.wavelengths = std::move(wavelengths);
  s.values = std::move(values);
  return s;
}

TEST(Table, BoxIsExactAtWholeNanometres) {
  const SpectrumTable t = tabulate(box(2, 400, 401), SpectrumRole::Emission);
  EXPECT_EQ(t[2 * 119], 0);
  EXPECT_EQ(t[2 * 119 + 1], 0);
  EXPECT_EQ(t[2 * 120], 2);
  EXPECT_EQ(t[2 * 120 + 1], 2);
  EXPECT_EQ(t[2 * 121], 0);
  EXPECT_EQ(table_integral(t), 2);
  EXPECT_EQ(evaluate(box(2, 400, 401), SpectrumRole::Emission, 400), 2);
  EXPECT_EQ(evaluate(box(2, 400, 401), SpectrumRole::Emission, 401), 0);
  EXPECT_EQ(evaluate(box(2, 400, 800), SpectrumRole::Emission, 780), 2);
}

TEST(Table, EdgesInsideACellKeepTheIntegral) {
  for (const auto& [a, b] : {std::pair{400.3, 420.8}, {500.2, 500.4}, {500.9, 501.1}, {279.0, 280.5}, {333.5, 999.0}}) {
    const SpectrumTable t = tabulate(box(3, a, b), SpectrumRole::Reflectance);
    EXPECT_NEAR(table_integral(t), 3 * (std::min(b, 780.0) - std::max(a, 280.0)), 1e-5) << a << " " << b;
    for (const float v : t) {
      EXPECT_GE(v, 0);
      EXPECT_LE(v, 3.000001f);
    }
  }
}

TEST(Table, KinksInsideACellKeepTheIntegral) {
  const SpectrumTable t = tabulate(sampled({400.25, 400.5, 400.75}, {0, 8, 0}), SpectrumRole::Dye);
  EXPECT_NEAR(table_integral(t), 2, 1e-6);
  EXPECT_NEAR(table_integral(t, 400, 401), 2, 1e-6);
}

TEST(Table, NarrowLinesKeepTheirEnergy) {
  Spectrum s;
  s.kind = SpectrumKind::Gaussian;
  s.value = 5;
  s.a = 546.07;
  for (const double stddev : {0.05, 0.2, 1.0, 2.9, 5.0}) {
    s.b = stddev;
    EXPECT_NEAR(table_integral(tabulate(s, SpectrumRole::Emission)) / (5 * stddev * std::sqrt(2 * M_PI)), 1, 1e-3) << stddev;
  }
}

TEST(Table, GaussianIsExactAtWholeNanometres) {
  Spectrum s;
  s.kind = SpectrumKind::Gaussian;
  s.value = 2, s.a = 365, s.b = 10;
  const SpectrumTable t = tabulate(s, SpectrumRole::Emission);
  for (int l = 280; l <= 780; l += 7) {
    const double z = (l - 365) / 10.0;
    EXPECT_NEAR(table_value(t, l), 2 * std::exp(-z * z / 2), 2e-7) << l;
    EXPECT_EQ(evaluate(s, SpectrumRole::Emission, l), 2 * std::exp(-0.5 * z * z));
  }
}

TEST(Table, SampledIsPiecewiseLinear) {
  const Spectrum s = sampled({300, 350, 500, 780}, {1, 3, 0, 4});
  const SpectrumTable t = tabulate(s, SpectrumRole::Reflectance);
  EXPECT_NEAR(table_value(t, 325.5), 1 + 2 * 25.5 / 50, 1e-6);
  EXPECT_NEAR(table_value(t, 500), 0, 1e-6);
  EXPECT_NEAR(table_value(t, 640), 2, 1e-6);
  EXPECT_NEAR(table_integral(t, 300, 780), 100 + 225 + 560, 1e-3);
  EXPECT_NEAR(table_integral(t, 325.5, 326), 0.5 * (1 + 2 * 25.75 / 50), 1e-6);
  EXPECT_EQ(table_integral(t, 400, 300), 0);
}

TEST(Table, Extrapolation) {
  Spectrum s = sampled({400, 700}, {2, 5});
  const auto ends = [&](SpectrumRole role) { return std::pair{evaluate(s, role, 399), evaluate(s, role, 750)}; };
  for (const auto role : {SpectrumRole::Reflectance, SpectrumRole::Index, SpectrumRole::Coefficient})
    EXPECT_EQ(ends(role), (std::pair{2.0, 5.0}));
  for (const auto role : {SpectrumRole::Emission, SpectrumRole::Dye}) EXPECT_EQ(ends(role), (std::pair{0.0, 0.0}));
  const SpectrumTable t = tabulate(s, SpectrumRole::Dye);
  EXPECT_EQ(t[2 * 119 + 1], 0);  // below the step at 400 nm
  EXPECT_EQ(t[2 * 120], 2);
  EXPECT_EQ(t[2 * 419 + 1], 5);
  EXPECT_EQ(t[2 * 420], 0);
  s.extrapolate = Extrapolate::Hold;
  EXPECT_EQ(ends(SpectrumRole::Emission), (std::pair{2.0, 5.0}));
  s.extrapolate = Extrapolate::Zero;
  EXPECT_EQ(ends(SpectrumRole::Reflectance), (std::pair{0.0, 0.0}));
}

TEST(Table, ScaleSumProduct) {
  Spectrum two = box(2, 400, 500), three = sampled({300, 700}, {3, 3}), sum, product;
  two.scale = 10;
  sum.kind = SpectrumKind::Sum;
  product.kind = SpectrumKind::Product;
  sum.of = product.of = {std::make_shared<Spectrum>(two), std::make_shared<Spectrum>(three)};
  sum.scale = 0.5;
  EXPECT_DOUBLE_EQ(evaluate(sum, SpectrumRole::Coefficient, 450), 11.5);
  EXPECT_DOUBLE_EQ(evaluate(sum, SpectrumRole::Coefficient, 550), 1.5);
  EXPECT_DOUBLE_EQ(evaluate(product, SpectrumRole::Coefficient, 450), 60);
  EXPECT_DOUBLE_EQ(table_integral(tabulate(product, SpectrumRole::Coefficient)), 6000);
}

// Schott BK7's published coefficients and its published n_d = 1.5168.
TEST(Table, IndicesOfRefraction) {
  Spectrum s;
  s.kind = SpectrumKind::Sellmeier;
  s.sellmeier_b = {1.03961212, 0.231792344, 1.01046945};
  s.sellmeier_c = {0.00600069867, 0.0200179144, 103.560653};
  EXPECT_NEAR(evaluate(s, SpectrumRole::Index, 587.6), 1.5168, 1e-5);
  s.kind = SpectrumKind::Cauchy;
  s.a = 1.5046, s.b = 0.0042;
  EXPECT_NEAR(evaluate(s, SpectrumRole::Index, 500), 1.5046 + 0.0042 / 0.25, 1e-12);
}

TEST(Table, NotFiniteNamesTheWavelength) {
  const Spectrum s = sampled({300, 400, 500}, {1, std::numeric_limits<double>::infinity(), 1});
  try {
    tabulate(s, SpectrumRole::Coefficient);
    FAIL();
  } catch (const std::domain_error& e) {
    EXPECT_NE(std::string(e.what()).find(" nm"), std::string::npos) << e.what();
  }
  EXPECT_THROW(tabulate(sampled({300, 400}, {1, 1e39}), SpectrumRole::Coefficient), std::domain_error);
}

TEST(Table, Constancy) {
  Spectrum s;
  s.value = 0.25;
  EXPECT_TRUE(is_constant(tabulate(s, SpectrumRole::Reflectance)));
  EXPECT_FALSE(is_constant(tabulate(s, SpectrumRole::Emission)));
  s.value = 0;
  EXPECT_TRUE(is_constant(tabulate(s, SpectrumRole::Emission)));
  EXPECT_FALSE(is_constant(tabulate(box(1, 300, 301), SpectrumRole::Dye)));
}

}  // namespace
}  // namespace stokes
