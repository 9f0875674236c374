// Upsampling of colours for curves: the fits of tabulate.h and those whose light is emitted. Internal to runtime/spectral.
#pragma once
#include <array>

#include "spectral/tabulate.h"

namespace stokes {

/// Coefficients in t = (lambda - 280) / 500, in double precision.
using SigmoidCoefficients = std::array<double, 3>;

/// As fit_sigmoid, before rounding to float.
SigmoidCoefficients fit_reflectance(Vec3d rgb);
/// The sigmoid S such that the pixel of the 1 nm table of d65() S is `rgb` to 1e-9; components in [0, 0.6].
SigmoidCoefficients fit_emission(Vec3d rgb);
double sigmoid_value(const SigmoidCoefficients& c, double lambda);

}  // namespace stokes
