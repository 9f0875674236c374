// The formulas of skin.h, and their samples at whole nanometres.
#include "spectral/skin.h"

#include <cmath>
#include <utility>

#include "spectral/data_tables.h"
#include "spectral/tabulate.h"

namespace stokes {
namespace {

template <typename Formula>
Spectrum sample_formula(std::string name, Formula formula) {
  Spectrum s;
  s.kind = SpectrumKind::Sampled;
  s.name = std::move(name);
  for (double lambda = kLambdaMin; lambda <= kLambdaMax; lambda += 1) {
    s.wavelengths.push_back(lambda);
    s.values.push_back(formula(lambda));
  }
  return s;
}

double mixed(double fraction, double a, double b) { return fraction * a + (1 - fraction) * b; }

}  // namespace

double skin_baseline_absorption(double lambda) { return 0.244 + 85.3 * std::exp(-(lambda - 154) / 66.2); }

double melanosome_absorption(double lambda) { return 6.6e11 * std::pow(lambda, -3.33); }

double blood_absorption(double lambda, double saturation) {
  const double extinction = mixed(saturation, kHemoglobin.interpolate(lambda, 1), kHemoglobin.interpolate(lambda, 2));
  return std::log(10.0) * extinction * 150 / 64500;
}

double skin_reduced_scattering(double lambda) { return 46.0 * std::pow(lambda / 500, -1.421); }

Spectrum epidermis_sigma_a(const SkinComposition& skin) {
  return sample_formula("epidermis absorption", [&](double lambda) {
    return mixed(skin.melanosomes, melanosome_absorption(lambda), skin_baseline_absorption(lambda));
  });
}

Spectrum dermis_sigma_a(const SkinComposition& skin) {
  return sample_formula("dermis absorption", [&](double lambda) {
    return mixed(skin.blood, blood_absorption(lambda, skin.saturation), skin_baseline_absorption(lambda));
  });
}

Spectrum skin_sigma_s(const SkinComposition& skin) {
  return sample_formula("skin scattering", [&](double lambda) { return skin_reduced_scattering(lambda) / (1 - skin.g); });
}

}  // namespace stokes
