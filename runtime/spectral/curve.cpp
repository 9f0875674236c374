// What each form of the scene format means as a function of the wavelength, in each role.
#include "spectral/curve.h"

#include <algorithm>
#include <cmath>

#include "spectral/cie.h"
#include "spectral/sigmoid.h"

namespace stokes {
namespace {

using Value = std::function<double(double, Side)>;

Curve constant_curve(double value) {
  return {[value](double, Side) { return value; }, {}};
}

Curve scaled(Curve curve, double factor) {
  if (factor == 1) return curve;
  return {[value = std::move(curve.value), factor](double lambda, Side side) { return factor * value(lambda, side); },
          std::move(curve.breaks)};
}

// A curve whose pixel has the luminance Y = 1, by the very sum that the film takes.
Curve with_unit_luminance(Curve curve) {
  const double luminance = integrate_xyz(sample_cells(curve)).y;
  return scaled(std::move(curve), 1 / luminance);
}

Curve d65_curve() {
  // The step is that of CIE's table, which begins at 300 nm.
  return {[](double lambda, Side side) { return side == Side::Left && lambda <= 300 ? 0 : d65(lambda); }, {300}};
}

Curve number_curve(double value, SpectrumRole role) {
  return role == SpectrumRole::Emission ? scaled(d65_curve(), value) : constant_curve(value);
}

Curve sigmoid_curve(const SigmoidCoefficients& c, double scale) {
  return {[c, scale](double lambda, Side) { return scale * sigmoid_value(c, lambda); }, {380}};
}

// D65 times the upsampled colour at half its brightness, where every colour has a comfortable fit, times two. The table holds the
// product at whole nanometres, so the pixel of the table is the colour itself.
Curve rgb_emission(Vec3d rgb) {
  const double brightest = std::max({rgb.x, rgb.y, rgb.z});
  if (brightest <= 0) return constant_curve(0);
  Curve light = d65_curve(), colour = sigmoid_curve(fit_emission(rgb / (2 * brightest)), 2 * brightest);
  return {[a = light.value, b = colour.value](double lambda, Side side) { return a(lambda, side) * b(lambda, side); }, {300, 380}};
}

// A reflectance, or a coefficient, which may exceed 1 (the fit is then for the colour divided by its largest component).
Curve rgb_curve(Vec3d rgb, SpectrumRole role) {
  const double brightest = std::max({rgb.x, rgb.y, rgb.z});
  const double scale = role == SpectrumRole::Reflectance ? 1 : std::max(1.0, brightest);
  return sigmoid_curve(fit_reflectance(rgb / scale), scale);
}

Curve with_uv(Curve curve, double uv) {
  const double edge = 380;
  return {[value = std::move(curve.value), uv, edge](double lambda, Side side) {
            return lambda < edge || (side == Side::Left && lambda <= edge) ? uv : value(lambda, side);
          },
          {300, edge}};
}

Curve upsampled(const Spectrum& s, SpectrumRole role) {
  const Vec3d zero, positive = max(s.rgb, zero), negative = max(-s.rgb, zero);
  Curve curve = role == SpectrumRole::Emission ? rgb_emission(positive) : rgb_curve(positive, role);
  const bool is_signed = role == SpectrumRole::Coefficient || role == SpectrumRole::Index;
  if (is_signed && length_squared(negative) > 0) {
    // Such as g = [0.5, 0, -0.5]: the difference of two upsampled colours.
    Curve below = rgb_curve(negative, role);
    curve.value = [a = curve.value, b = below.value](double lambda, Side side) { return a(lambda, side) - b(lambda, side); };
  }
  return s.uv ? with_uv(std::move(curve), *s.uv) : curve;
}

bool holds_outside(const Spectrum& s, SpectrumRole role) {
  if (s.extrapolate != Extrapolate::Default) return s.extrapolate == Extrapolate::Hold;
  return role != SpectrumRole::Emission && role != SpectrumRole::Dye;
}

Curve sampled_curve(const Spectrum& s, SpectrumRole role) {
  if (s.wavelengths.empty()) return constant_curve(0);
  Value value = [at = s.wavelengths, values = s.values, hold = holds_outside(s, role)](double lambda, Side side) {
    const bool before = side == Side::Left ? lambda <= at.front() : lambda < at.front();
    const bool after = side == Side::Left ? lambda > at.back() : lambda >= at.back();
    if (before || after) return hold ? (before ? values.front() : values.back()) : 0.0;
    const std::size_t i = std::clamp<std::size_t>(std::upper_bound(at.begin(), at.end(), lambda) - at.begin(), 1, at.size() - 1);
    const double f = (lambda - at[i - 1]) / (at[i] - at[i - 1]);
    return values[i - 1] * (1 - f) + values[i] * f;
  };
  return {std::move(value), s.wavelengths};
}

Curve box_curve(double value, double a, double b) {
  return {[=](double lambda, Side side) {
            const bool inside = side == Side::Left ? lambda > a && lambda <= b : lambda >= a && lambda < b;
            return inside ? value : 0.0;
          },
          {a, b}};
}

Curve gaussian_curve(double value, double mean, double stddev) {
  Curve curve{[=](double lambda, Side) { return value * std::exp(-0.5 * ((lambda - mean) / stddev) * ((lambda - mean) / stddev)); }, {}};
  // A narrow line would slip between the whole nanometres.
  if (stddev < 3)
    for (int i = -16; i <= 16; i++) curve.breaks.push_back(mean + i * stddev / 2);
  return curve;
}

Curve blackbody_curve(double kelvin) {
  // Planck's law relative to its value at 780 nm, as any factor is normalised away; by logarithms, so that no temperature overflows.
  const double c2 = 1.438776877e7;  // nm K
  const auto log_power = [=](double lambda) {
    const double x = c2 / (lambda * kelvin);
    return -5 * std::log(lambda) - (x > 30 ? x : std::log(std::expm1(x)));
  };
  const double reference = log_power(kLambdaMax);
  return with_unit_luminance({[=](double lambda, Side) { return std::exp(log_power(lambda) - reference); }, {}});
}

Curve illuminant_curve(const std::string& name) {
  if (name == "D65") return d65_curve();  // its luminance is 1 already
  Curve curve{[name](double lambda, Side side) { return illuminant_power(name, lambda, side == Side::Left); }, {}};
  if (name == "F11") curve.breaks = {380};
  return with_unit_luminance(std::move(curve));
}

Curve sellmeier_curve(const Spectrum& s) {
  return {[b = s.sellmeier_b, c = s.sellmeier_c](double lambda, Side) {
            const double square = lambda * lambda * 1e-6;  // um^2
            double n2 = 1;
            for (int i = 0; i < 3; i++) n2 += b[i] * square / (square - c[i]);
            return std::sqrt(n2);
          },
          {}};
}

// True for forms that are a spectral power by themselves, where numbers and colours are D65-shaped.
bool is_power(const Spectrum& s) {
  if (s.kind == SpectrumKind::Number || s.kind == SpectrumKind::Rgb) return false;
  return s.of.empty() || std::any_of(s.of.begin(), s.of.end(), [](const SpectrumPtr& part) { return is_power(*part); });
}

// In a product of emissions one factor is the light and numbers and colours among the others are filters: 0.5 times illuminant A is
// half of A, and not A times D65.
std::vector<Curve> factors(const Spectrum& s, SpectrumRole role) {
  std::vector<Curve> curves;
  const auto light = std::find_if(s.of.begin(), s.of.end(), [](const SpectrumPtr& part) { return is_power(*part); });
  const std::size_t light_index = light == s.of.end() ? 0 : light - s.of.begin();
  for (std::size_t i = 0; i < s.of.size(); i++) {
    const bool filter = role == SpectrumRole::Emission && i != light_index && !is_power(*s.of[i]);
    curves.push_back(make_curve(*s.of[i], filter ? SpectrumRole::Coefficient : role));
  }
  return curves;
}

Curve combined(std::vector<Curve> parts, bool multiply) {
  std::vector<double> breaks;
  for (const Curve& part : parts) breaks.insert(breaks.end(), part.breaks.begin(), part.breaks.end());
  Value value = [parts = std::move(parts), multiply](double lambda, Side side) {
    double result = multiply ? 1 : 0;
    for (const Curve& part : parts) {
      const double v = part.value(lambda, side);
      result = multiply ? result * v : result + v;
    }
    return result;
  };
  return {std::move(value), std::move(breaks)};
}

std::vector<Curve> terms(const Spectrum& s, SpectrumRole role) {
  std::vector<Curve> curves;
  for (const SpectrumPtr& part : s.of) curves.push_back(make_curve(*part, role));
  return curves;
}

Curve unscaled_curve(const Spectrum& s, SpectrumRole role) {
  switch (s.kind) {
    case SpectrumKind::Number: return number_curve(s.value, role);
    case SpectrumKind::Rgb: return upsampled(s, role);
    case SpectrumKind::Sampled: return sampled_curve(s, role);
    case SpectrumKind::Constant: return constant_curve(s.value);
    case SpectrumKind::Box: return box_curve(s.value, s.a, s.b);
    case SpectrumKind::Gaussian: return gaussian_curve(s.value, s.a, s.b);
    case SpectrumKind::Blackbody: return blackbody_curve(s.a);
    case SpectrumKind::Illuminant: return illuminant_curve(s.illuminant);
    case SpectrumKind::Cauchy: return {[a = s.a, b = s.b](double lambda, Side) { return a + b * 1e6 / (lambda * lambda); }, {}};
    case SpectrumKind::Sellmeier: return sellmeier_curve(s);
    case SpectrumKind::Product: return combined(factors(s, role), true);
    case SpectrumKind::Sum: return combined(terms(s, role), false);
  }
  return constant_curve(0);
}

}  // namespace

Curve make_curve(const Spectrum& s, SpectrumRole role) { return scaled(unscaled_curve(s, role), s.scale); }

}  // namespace stokes
