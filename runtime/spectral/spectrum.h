// What a scene says about a spectrum: one of the forms of the scene format, before it is tabulated.
// Knows nothing of JSON, scenes or devices.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"

namespace stokes {

enum class SpectrumKind { Number, Rgb, Sampled, Constant, Box, Gaussian, Blackbody, Illuminant, Cauchy, Sellmeier, Product, Sum };

/// How a spectrum is used, which decides what a number or an RGB triple means and what a sampled curve is outside its range.
enum class SpectrumRole {
  Reflectance,  ///< albedo, scatter albedo: unitless in [0, 1]; held outside its samples
  Emission,     ///< radiance per nm; a number or RGB is D65-shaped; zero outside its samples
  Index,        ///< index of refraction, extinction coefficient k; held
  Coefficient,  ///< sigma_t, sigma_s, sigma_a, media's albedo and g; held
  Dye           ///< absorption or emission curve of a fluorescent material; zero outside its samples
};

enum class Extrapolate { Default, Zero, Hold };

/// One spectrum in any form of the scene format. Files are read at parse time and stored as Sampled.
struct Spectrum {
  SpectrumKind kind = SpectrumKind::Number;
  double value = 0;                         ///< Number, Constant, Box, Gaussian
  Vec3d rgb;                                ///< Rgb: linear sRGB
  std::vector<double> wavelengths, values;  ///< Sampled: strictly increasing nm, finite values
  double a = 0, b = 0;                      ///< Box: range; Gaussian: mean, stddev; Cauchy: A, B (um^2); Blackbody: a = kelvin
  std::array<double, 3> sellmeier_b{}, sellmeier_c{};
  std::string illuminant;                   ///< "D65", "A", "E", "F11"
  std::vector<std::shared_ptr<const Spectrum>> of;  ///< Product, Sum
  double scale = 1;
  Extrapolate extrapolate = Extrapolate::Default;
  std::optional<double> uv;  ///< Rgb: the value below 380 nm instead of the held one
  std::string name;
  std::string pointer;  ///< JSON pointer of its place in the scene, for messages
};
using SpectrumPtr = std::shared_ptr<const Spectrum>;

}  // namespace stokes
