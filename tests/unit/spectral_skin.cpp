// Skin's chromophores against numbers worked out by hand from the published formulas, and against the features of blood's spectrum.
#include <gtest/gtest.h>

#include <cmath>

#include "spectral/skin.h"
#include "spectral/tabulate.h"

namespace stokes {
namespace {

TEST(Skin, FormulasAt500nm) {
  EXPECT_NEAR(skin_baseline_absorption(500), 0.7022, 2e-4);  // 0.244 + 85.3 e^-5.2266
  EXPECT_NEAR(melanosome_absorption(500), 679.2, 0.2);       // 6.6e11 e^(-3.33 * 6.214608)
  EXPECT_NEAR(skin_reduced_scattering(500), 46, 1e-12);
  EXPECT_NEAR(skin_reduced_scattering(1000), 46 * 0.37347, 1e-3);
}

// Prahl's table: at 500 nm 20932.8 (HbO2) and 20862 (Hb); at 664 nm Hb absorbs more than nine times as much.
TEST(Skin, Blood) {
  const double to_per_cm = 2.302585093 * 150 / 64500;
  EXPECT_NEAR(blood_absorption(500, 1), 20932.8 * to_per_cm, 1e-3);
  EXPECT_NEAR(blood_absorption(500, 0), 20862 * to_per_cm, 1e-3);
  EXPECT_NEAR(blood_absorption(501, 0.5), (blood_absorption(500, 0.5) + blood_absorption(502, 0.5)) / 2, 1e-9);
  EXPECT_GT(blood_absorption(664, 0), 9 * blood_absorption(664, 1));
  // The oxygenated double peak at 542 and 576 nm with its valley at 560 nm, where deoxygenated blood has its peak.
  EXPECT_GT(blood_absorption(542, 1), 1.4 * blood_absorption(560, 1));
  EXPECT_GT(blood_absorption(576, 1), 1.4 * blood_absorption(560, 1));
  EXPECT_GT(blood_absorption(556, 0), blood_absorption(576, 0));
}

TEST(Skin, MixturesAreSpectra) {
  const SkinComposition skin{.melanosomes = 0.1, .blood = 0.02, .saturation = 0.6, .g = 0.9};
  for (const double l : {280.0, 412.0, 577.0, 780.0}) {
    const double base = skin_baseline_absorption(l);
    EXPECT_NEAR(evaluate(epidermis_sigma_a(skin), SpectrumRole::Coefficient, l), 0.1 * melanosome_absorption(l) + 0.9 * base, 1e-9) << l;
    EXPECT_NEAR(evaluate(dermis_sigma_a(skin), SpectrumRole::Coefficient, l), 0.02 * blood_absorption(l, 0.6) + 0.98 * base, 1e-9) << l;
    EXPECT_NEAR(evaluate(skin_sigma_s(skin), SpectrumRole::Coefficient, l), 10 * skin_reduced_scattering(l), 1e-9) << l;
  }
}

}  // namespace
}  // namespace stokes
