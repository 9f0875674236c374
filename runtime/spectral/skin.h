// Absorption and scattering of skin by its chromophores, as spectra for media. Knows nothing of layers, meshes or scenes.
#pragma once
#include "spectral/spectrum.h"

namespace stokes {

/// Absorption of skin without melanin and blood, 1/cm, at `lambda` nm: 0.244 + 85.3 exp(-(lambda - 154) / 66.2). Jacques 1998.
double skin_baseline_absorption(double lambda);

/// Absorption of the inside of a melanosome, 1/cm: 6.6e11 lambda^-3.33. Jacques 1998.
double melanosome_absorption(double lambda);

/// Absorption of whole blood of 150 g/l haemoglobin (64500 g/mol) with the fraction `saturation` in [0, 1] of it oxygenated, 1/cm:
/// ln(10) eps 150 / 64500, with Prahl's molar extinctions eps in 1/(cm M), measured from 250 to 1000 nm.
double blood_absorption(double lambda, double saturation);

/// Reduced scattering coefficient of skin, sigma_s (1 - g), in 1/cm: 46.0 (lambda / 500)^-1.421. Jacques 2013.
double skin_reduced_scattering(double lambda);

/// What the skin presets ask for. Volume fractions are in [0, 1].
struct SkinComposition {
  double melanosomes = 0.02;  ///< of the epidermis: 0.013-0.063 light, 0.11-0.16 moderate, 0.18-0.43 dark skin
  double blood = 0.01;        ///< of the dermis: 0.002 at rest to 0.07 flushed
  double saturation = 0.75;   ///< oxygenated part of the haemoglobin
  double g = 0.85;            ///< mean cosine of the scattering angle, 0.8 to 0.9
};

/// sigma_a of the epidermis, 1/cm: melanosomes in bloodless skin. Sampled at 1 nm over 280-780 nm, as are all of these.
Spectrum epidermis_sigma_a(const SkinComposition& skin);
/// sigma_a of the dermis, 1/cm: blood in bloodless skin.
Spectrum dermis_sigma_a(const SkinComposition& skin);
/// sigma_s of epidermis and dermis alike, 1/cm: the reduced coefficient over 1 - g.
Spectrum skin_sigma_s(const SkinComposition& skin);

}  // namespace stokes
