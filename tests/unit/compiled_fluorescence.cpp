// Dyes and measured matrices: normalisation, energies, what excitation wavelengths are drawn from.
#include <cmath>

#include "compiled_scenes.h"

namespace stokes::test {
namespace {

DyeDescription dye(SpectrumPtr absorption, SpectrumPtr emission) {
  DyeDescription d;
  d.absorption = std::move(absorption), d.emission = std::move(emission);
  d.pointer = "/materials/0";
  return d;
}
MaterialDescription fluorescent(DyeDescription d, double base = 0) {
  MaterialDescription m = material(MaterialKind::DiffuseFluorescent);
  m.albedo.spectrum = number(base);
  m.dyes = {std::move(d)};
  return m;
}
SceneDescription lit(MaterialDescription m) { return scene_of({quad(share(std::move(m))), quad(light(box(300, 350, 2)), {}, 1, 1)}); }

double integral(const CompiledScene& s, std::uint32_t t) {
  double sum = 0;
  for (std::size_t i = 0; i < 1000; i++) sum += s.spectra[t * 1000 + i] / 2;
  return sum;
}

TEST(CompiledDye, FoldsConcentrationAndNormalisesEmission) {
  DyeDescription d = dye(box(300, 400, 0.8), box(500, 550, 7));
  d.concentration = 0.5, d.yield = 0.9;
  CompiledScene s = compile_scene(lit(fluorescent(d)));
  EXPECT_TRUE(s.features.fluorescent_surfaces);
  ASSERT_EQ(s.dyes.size(), 1u);
  EXPECT_FLOAT_EQ(table_at(s, s.dyes[0].absorption, 350), 0.4f);
  EXPECT_NEAR(integral(s, s.dyes[0].emission), 1, 1e-6);
  EXPECT_EQ(s.dyes[0].flags, DYE_PHOTON_YIELD);
  EXPECT_NEAR(s.dyes[0].strength, 0.4 * 0.9 * (400 * 400 - 300 * 300) / 2.0, 2);
  d.photon_yield = false, d.stokes = true;
  s = compile_scene(lit(fluorescent(d)));
  EXPECT_EQ(s.dyes[0].flags, DYE_STOKES);
  EXPECT_NEAR(s.dyes[0].strength, 0.4 * 0.9 * 100, 1e-3);
}

// Half the density follows the absorption, half its product with the only light, 300-350 nm.
TEST(CompiledDye, ExcitationMixesAbsorptionAndLight) {
  DyeDescription d = dye(box(300, 400, 0.8), box(500, 550, 7));
  d.photon_yield = false;
  const CompiledScene s = compile_scene(lit(fluorescent(d)));
  const layout::Distribution& e = s.distributions.at(s.dyes[0].excitation);
  EXPECT_NEAR(e.integral, 1, 1e-5);
  EXPECT_NEAR(table_at(s, e.spectrum, 320), 0.5 / 100 + 0.5 / 50, 1e-6);
  EXPECT_NEAR(table_at(s, e.spectrum, 380), 0.5 / 100, 1e-6);
  EXPECT_EQ(table_at(s, e.spectrum, 450), 0);
  ASSERT_EQ(s.cdfs.size(), std::size_t(STOKES_CDF_STRIDE));
  EXPECT_EQ(s.cdfs[0], 0);
  EXPECT_EQ(s.cdfs[4 * 499 + 1], 1);
  EXPECT_NEAR(s.cdfs[4 * 70], 0.75, 1e-5);  // at 350 nm
  EXPECT_NEAR(s.cdfs[4 * 70 + 1] - s.cdfs[4 * 70], 0.5 / 100, 1e-5);
}

// An overlap where emission lies below the excitation gains energy under a photon yield: at 600 nm a photon of 550 nm comes out.
TEST(CompiledDye, MustConserveEnergy) {
  EXPECT_EQ(error_of(lit(fluorescent(dye(box(300, 400, 1), box(500, 550, 1))))), "");
  DyeDescription d = dye(box(300, 600, 1), box(500, 550, 1));
  std::string error = error_of(lit(fluorescent(d)));
  EXPECT_NE(error.find("1.14"), std::string::npos) << error;
  EXPECT_NE(error.find("600 nm"), std::string::npos) << error;
  d.stokes = true;
  EXPECT_EQ(error_of(lit(fluorescent(d))), "");
  // Base and dye together: (1 - 0.5) 1 + 0.5 * 1.2 for an energy yield of 1.2.
  d = dye(box(300, 400, 0.5), box(500, 550, 1));
  d.photon_yield = false;
  EXPECT_EQ(error_of(lit(fluorescent(d, 1))), "");
  d.yield = 1.2;
  EXPECT_EQ(error_of(lit(fluorescent(d, 0))), "");
  error = error_of(lit(fluorescent(d, 1)));
  EXPECT_NE(error.find("1.1"), std::string::npos) << error;
  // Two dyes that absorb more than everything.
  MaterialDescription m = fluorescent(dye(box(300, 400, 0.7), box(500, 550, 1)));
  m.dyes.push_back(m.dyes[0]);
  EXPECT_NE(error_of(lit(m)).find("absorb 1.4"), std::string::npos) << error_of(lit(m));
}

TEST(CompiledDye, RefusesWhatIsNoDye) {
  DyeDescription d = dye(box(300, 400, 1), box(500, 550, 0));
  EXPECT_NE(error_of(lit(fluorescent(d))).find("emission curve is zero"), std::string::npos);
  d = dye(nullptr, box(500, 550, 1));
  EXPECT_NE(error_of(lit(fluorescent(d))).find("absorption"), std::string::npos);
  d = dye(box(300, 400, 1), box(500, 550, 1));
  d.concentration = 2;
  EXPECT_NE(error_of(lit(fluorescent(d))).find("concentration"), std::string::npos);
  d = dye(box(300, 400, 1), box(500, 550, 1));
  SceneDescription scene = lit(fluorescent(d));
  scene.integrator.mode = ColorMode::Rgb;
  EXPECT_NE(error_of(scene).find("rgb mode"), std::string::npos);
}

TEST(CompiledDye, OfAMediumAddsToItsExtinction) {
  MediumDescription m;
  m.sigma_t = number(2), m.sigma_s = number(2);
  m.unit = LengthUnit::Millimetre;
  m.dyes = {dye(box(300, 400, 3), box(500, 550, 1))};
  m.dyes[0].concentration = 0.5;
  m.pointer = "/media/0";
  SurfaceDescription s = sphere(lambertian());
  s.inside = std::make_shared<const MediumDescription>(m);
  SceneDescription scene = scene_of({s});
  scene.scene_unit = LengthUnit::Centimetre;
  const CompiledScene c = compile_scene(scene);
  EXPECT_TRUE(c.features.fluorescent_media && c.features.chromatic_media);
  EXPECT_FLOAT_EQ(table_at(c, c.media[1].sigma_t, 350), 35);
  EXPECT_FLOAT_EQ(table_at(c, c.media[1].sigma_s, 350), 20);
  EXPECT_FLOAT_EQ(table_at(c, c.media[1].sigma_t, 450), 20);
  EXPECT_FLOAT_EQ(table_at(c, c.dyes[c.media[1].first_dye].absorption, 350), 15);
}

// 300-500 nm by 50: excitation at 300 and 350 re-emitted at 450, a diagonal of 0.4, noise, and one column that gives off 2.
ReradiationMatrix matrix() {
  ReradiationMatrix m;
  m.li = m.lo = {300, 350, 400, 450, 500};
  m.values.assign(25, 0.0);
  for (std::size_t i = 0; i < 5; i++) m.values[i * 5 + i] = 0.4;
  m.values[3 * 5 + 0] = 0.2;
  m.values[3 * 5 + 1] = 1.6;
  m.values[2 * 5 + 4] = 0.1;  // row 400 has a density of its own, away from what row 450 lends it
  m.values[1 * 5 + 2] = -0.01;
  return m;
}

TEST(CompiledReradiation, TakesTheDiagonalApartAndConservesEnergy) {
  MaterialDescription d = material(MaterialKind::Reradiation);
  d.matrix = std::make_shared<const ReradiationMatrix>(matrix());
  const CompiledScene s = compile_scene(lit(d));
  EXPECT_TRUE(s.features.reradiation);
  const layout::Material& m = s.materials[s.surfaces[0].material];
  const layout::Reradiation& r = s.reradiations.at(m.first_dye);
  EXPECT_EQ(r.columns, 5u);
  EXPECT_EQ(r.rows, 5u);
  const auto k = [&](std::size_t row, std::size_t column) { return s.reradiation_values.at(r.offset + row * 5 + column); };
  EXPECT_FLOAT_EQ(k(3, 0), 0.2f / 50);
  EXPECT_FLOAT_EQ(k(3, 1), 0.8f / 50);  // the column gave off 2
  EXPECT_EQ(k(1, 2), 0);
  for (std::size_t i = 0; i < 5; i++) EXPECT_EQ(k(i, i), 0);
  EXPECT_FLOAT_EQ(table_at(s, m.albedo, 300), 0.4f);
  EXPECT_FLOAT_EQ(table_at(s, m.albedo, 350), 0.2f);
  EXPECT_FLOAT_EQ(table_at(s, m.albedo, 325), 0.3f);
  EXPECT_FLOAT_EQ(table_at(s, m.albedo, 700), 0.4f);
  ASSERT_FALSE(s.warnings.empty());
  EXPECT_NE(s.warnings[0].find("1 column"), std::string::npos);
}

// Wherever the bilinear K is positive, the density of the nearest row must be, too.
TEST(CompiledReradiation, ExcitationCoversTheBilinearMatrix) {
  MaterialDescription d = material(MaterialKind::Reradiation);
  d.matrix = std::make_shared<const ReradiationMatrix>(matrix());
  const CompiledScene s = compile_scene(lit(d));
  const layout::Reradiation& r = s.reradiations.at(0);
  for (int lo = 300; lo <= 500; lo += 5)
    for (int li = 301; li < 500; li += 7) {
      const double x = (li - 300) / 50.0, y = (lo - 300) / 50.0;
      const auto c0 = std::min(std::size_t(x), std::size_t(3)), r0 = std::min(std::size_t(y), std::size_t(3));
      const auto k = [&](std::size_t row, std::size_t column) { return double(s.reradiation_values[r.offset + row * 5 + column]); };
      const double fx = x - double(c0), fy = y - double(r0);
      const double value = (k(r0, c0) * (1 - fx) + k(r0, c0 + 1) * fx) * (1 - fy) + (k(r0 + 1, c0) * (1 - fx) + k(r0 + 1, c0 + 1) * fx) * fy;
      const layout::Distribution& e = s.distributions.at(r.first_excitation + std::size_t(std::lround(y)));
      if (value <= 0) continue;
      EXPECT_GT(table_at(s, e.spectrum, li), 0) << li << " to " << lo;
    }
}

}  // namespace
}  // namespace stokes::test
