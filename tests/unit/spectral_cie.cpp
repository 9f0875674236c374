// The colour side of the spectrum: CIE sums, white, illuminants, and the sensor table that the film uses.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "spectral/data_tables.h"
#include "spectral/tabulate.h"

namespace stokes {
namespace {

Spectrum of_kind(SpectrumKind kind) {
  Spectrum s;
  s.kind = kind;
  return s;
}

Spectrum illuminant(const char* name) {
  Spectrum s = of_kind(SpectrumKind::Illuminant);
  s.illuminant = name;
  return s;
}

// What a film with infinitely many samples shows: the sensor times the table, integrated exactly over the cells.
Vec3d pixel(const SpectrumTable& t) {
  static const std::vector<float> sensor = sensor_table();
  double rgb[3] = {};
  for (int c = 0; c < kSpectrumCells; c++)
    for (int k = 0; k < 3; k++) {
      const double s0 = sensor[8 * c + k], s1 = sensor[8 * c + 4 + k], l0 = t[2 * c], l1 = t[2 * c + 1];
      rgb[k] += (s0 * l0 + s1 * l1) / 3 + (s0 * l1 + s1 * l0) / 6;
    }
  return {rgb[0], rgb[1], rgb[2]};
}

void expect_near(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// CIE 1931 2-degree, sums at 1 nm from 360 to 830 nm as published.
TEST(Cie, Sums) {
  Vec3d sum;
  for (int l = 360; l <= 830; l++) sum += cie_xyz(l);
  expect_near(sum, {106.8655, 106.8569, 106.8923}, 1e-4);
  EXPECT_NEAR(kYbarIntegral, sum.y, 1e-4);
}

TEST(Cie, ZeroOutsideAndNeverHeld) {
  for (const double l : {280.0, 359.999, 830.001, 900.0}) expect_near(cie_xyz(l), {}, 0);
  EXPECT_GT(cie_xyz(360).x, 0);
  EXPECT_NEAR(cie_xyz(555).y, 1, 1e-9);
  const std::vector<float> sensor = sensor_table();
  ASSERT_EQ(sensor.size(), 4000u);
  for (int i = 0; i < 8 * 80; i++) EXPECT_EQ(sensor[i], 0) << i;
  EXPECT_NE(sensor[8 * 80], 0);
  for (int i = 3; i < 4000; i += 4) EXPECT_EQ(sensor[i], 0);
}

TEST(Cie, MatricesAreInverse) {
  for (const Vec3d rgb : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0.2, 0.3, 0.9}}) expect_near(xyz_to_rgb(rgb_to_xyz(rgb)), rgb, 1e-12);
  expect_near(rgb_to_xyz({0, 1, 0}), {0.35758, 0.71517, 0.11919}, 1e-5);
}

TEST(Illuminants, D65IsWhiteAndCloseToTheTable) {
  expect_near(pixel(tabulate(illuminant("D65"), SpectrumRole::Emission)), {1, 1, 1}, 1e-5);
  // The factor that makes it exactly white is nowhere far from 1 (where the eye sees), relative to the published table.
  double scale = 0;
  for (int l = 380; l <= 780; l++) scale += d65(l) / kIlluminantD65.interpolate(l, 1) / 401;
  for (int l = 300; l <= 780; l += 5) EXPECT_NEAR(d65(l) / (scale * kIlluminantD65.interpolate(l, 1)), 1, l < 380 ? 2e-3 : 1e-3) << l;
  EXPECT_EQ(d65(299.9), 0);
}

TEST(Illuminants, LuminanceIsOne) {
  for (const char* name : {"D65", "A", "E", "F11"})
    EXPECT_NEAR(emission_xyz(tabulate(illuminant(name), SpectrumRole::Emission)).y, 1, 1e-6) << name;
  for (const double kelvin : {500.0, 1000.0, 2856.0, 6500.0, 20000.0}) {
    Spectrum s = of_kind(SpectrumKind::Blackbody);
    s.a = kelvin;
    EXPECT_NEAR(emission_xyz(tabulate(s, SpectrumRole::Emission)).y, 1, 1e-6) << kelvin;
  }
  EXPECT_THROW(tabulate(illuminant("D50"), SpectrumRole::Emission), std::domain_error);
}

// Published chromaticities: A 0.44758, 0.40745; F11 (FL11) 0.38052, 0.37713; E 1/3.
TEST(Illuminants, Chromaticities) {
  const auto expect_xy = [](const char* name, double x, double y, double tolerance) {
    const Vec3d xyz = emission_xyz(tabulate(illuminant(name), SpectrumRole::Emission));
    EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), x, tolerance) << name;
    EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), y, tolerance) << name;
  };
  expect_xy("A", 0.44758, 0.40745, 1e-4);
  expect_xy("E", 1 / 3.0, 1 / 3.0, 1e-4);
  expect_xy("F11", 0.38052, 0.37713, 5e-4);
  expect_xy("D65", 0.3127, 0.3290, 1e-5);
}

// A black body at 2856 K is what illuminant A stands for (its table is 2848 K with an older constant), and continues it below 300 nm.
TEST(Illuminants, AIsABlackbody) {
  Spectrum body = of_kind(SpectrumKind::Blackbody);
  body.a = 2855.5;
  const SpectrumTable a = tabulate(illuminant("A"), SpectrumRole::Emission), b = tabulate(body, SpectrumRole::Emission);
  for (double l = 280; l <= 780; l += 5) EXPECT_NEAR(table_value(a, l) / table_value(b, l), 1, 2e-3) << l;
  for (double l = 300; l <= 700; l += 50) EXPECT_NEAR(table_value(a, l + 0.0), evaluate(illuminant("A"), SpectrumRole::Emission, l), 1e-6);
}

TEST(Emission, NumbersAndColoursAreExactPixels) {
  Spectrum grey = of_kind(SpectrumKind::Number);
  grey.value = 3;
  grey.scale = 2;
  expect_near(pixel(tabulate(grey, SpectrumRole::Emission)), {6, 6, 6}, 3e-5);
  Spectrum colour = of_kind(SpectrumKind::Rgb);
  for (const Vec3d rgb : {Vec3d{1, 1, 1}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 1, 1}, Vec3d{1, 0, 1}, Vec3d{1, 1, 0},
                          Vec3d{0.2, 0.5, 0.7}, Vec3d{20, 3, 1}, Vec3d{1e-4, 2e-4, 3e-5}}) {
    colour.rgb = rgb;
    const SpectrumTable t = tabulate(colour, SpectrumRole::Emission);
    expect_near(pixel(t), rgb, 1e-5 * std::max({rgb.x, rgb.y, rgb.z}));
    for (const float v : t) EXPECT_GE(v, 0);
    expect_near(xyz_to_rgb(emission_xyz(t)), pixel(t), 1e-6 * std::max({rgb.x, rgb.y, rgb.z}));
  }
  colour.rgb = {-1, 0, 0};
  expect_near(pixel(tabulate(colour, SpectrumRole::Emission)), {}, 0);
}

// A truly constant emission has the colour of illuminant E, computed from the published sums and matrix.
TEST(Emission, ConstantIsIlluminantE) {
  Spectrum s = of_kind(SpectrumKind::Constant);
  s.value = 2;
  const SpectrumTable t = tabulate(s, SpectrumRole::Emission);
  for (const float v : t) EXPECT_EQ(v, 2);
  expect_near(pixel(t) / 2, {1.20506, 0.94822, 0.90898}, 2e-5);
}

TEST(Emission, ProductsFilterOneLight) {
  Spectrum half = of_kind(SpectrumKind::Number), product = of_kind(SpectrumKind::Product);
  half.value = 0.5;
  product.of = {std::make_shared<Spectrum>(half), std::make_shared<Spectrum>(illuminant("A"))};
  const SpectrumTable t = tabulate(product, SpectrumRole::Emission), a = tabulate(illuminant("A"), SpectrumRole::Emission);
  for (int i = 0; i < 1000; i++) EXPECT_FLOAT_EQ(t[i], 0.5f * a[i]);
  product.of = {std::make_shared<Spectrum>(half), std::make_shared<Spectrum>(half)};
  expect_near(pixel(tabulate(product, SpectrumRole::Emission)), {0.25, 0.25, 0.25}, 1e-5);
}

TEST(RgbMode, ThreeNumbers) {
  Spectrum s = of_kind(SpectrumKind::Number);
  s.value = 0.3;
  for (const auto role : {SpectrumRole::Emission, SpectrumRole::Reflectance, SpectrumRole::Index})
    for (const float v : rgb_of(s, role)) EXPECT_FLOAT_EQ(v, 0.3f);
  s = of_kind(SpectrumKind::Rgb);
  s.rgb = {0.1, 2, -1};
  EXPECT_EQ(rgb_of(s, SpectrumRole::Emission), (std::array<float, 3>{0.1f, 2, 0}));
  EXPECT_EQ(rgb_of(s, SpectrumRole::Reflectance), (std::array<float, 3>{0.1f, 1, 0}));
  EXPECT_EQ(rgb_of(s, SpectrumRole::Coefficient), (std::array<float, 3>{0.1f, 2, -1}));
  s = of_kind(SpectrumKind::Cauchy);
  s.a = 1.5, s.b = 0.01;
  for (const float v : rgb_of(s, SpectrumRole::Index)) EXPECT_FLOAT_EQ(v, float(1.5 + 0.01 / (0.5876 * 0.5876)));
  // A saturated filter has negative components; as a reflectance it stays within its own values.
  s = of_kind(SpectrumKind::Box);
  s.value = 1, s.a = 490, s.b = 510;
  EXPECT_LT(rgb_of(s, SpectrumRole::Emission)[0], 0);
  EXPECT_EQ(rgb_of(s, SpectrumRole::Reflectance)[0], 0);
}

// Published sRGB codes of the red and white patches; they were computed for D50 and adapted, hence the tolerance.
TEST(Data, ColorCheckerColours) {
  const auto srgb = [](double v) { return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055); };
  const auto patch = [](const char* name) {
    return rgb_of(table_spectrum(kColorChecker, kColorChecker.column(name)), SpectrumRole::Reflectance);
  };
  const auto red = patch("red");
  EXPECT_NEAR(srgb(red[0]), 175, 5);
  EXPECT_NEAR(srgb(red[1]), 54, 8);
  EXPECT_NEAR(srgb(red[2]), 60, 5);
  const auto white = patch("white 9.5 (.05 D)");
  EXPECT_NEAR(srgb(white[1]), 243, 4);
  EXPECT_THROW(kColorChecker.column("ultraviolet"), std::out_of_range);
  EXPECT_EQ(kMonkSkinTones.rows(), 10u);
}

}  // namespace
}  // namespace stokes
