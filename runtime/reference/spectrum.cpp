// Spectrum tables, the camera's wavelengths and excitation wavelengths. See spectrum.h.
#include "reference/spectrum.h"

#include <algorithm>
#include <cmath>

namespace stokes::reference {
namespace {

struct CellPosition {
  std::size_t cell;
  double fraction;
};

CellPosition cell_at(double nm) {
  const double x = std::clamp(nm, double(STOKES_LAMBDA_MIN), double(STOKES_LAMBDA_MAX)) - STOKES_LAMBDA_MIN;
  const double cell = std::min(std::floor(x), STOKES_SPECTRUM_CELLS - 1.0);
  return {static_cast<std::size_t>(cell), x - cell};
}

double lerp(double a, double b, double t) { return a + t * (b - a); }

/// The x in [0, 1] where the integral of the line from a to b (a, b >= 0) reaches the fraction u of its whole.
double sample_linear(double a, double b, double u) {
  if (a == b) return u;
  const double root = std::sqrt(lerp(a * a, b * b, u));
  return std::clamp((root - a) / (b - a), 0.0, 1.0);
}

}  // namespace

CameraWavelength camera_wavelength(const CompiledScene& scene, double u) {
  CameraWavelength result;
  if (scene.features.rgb) {
    const int channel = std::min(2, static_cast<int>(u * 3));
    result.wavelength.channel = channel;
    result.film_weight = {channel == 0 ? 3.0 : 0.0, channel == 1 ? 3.0 : 0.0, channel == 2 ? 3.0 : 0.0};
    return result;
  }
  const double x = u * STOKES_CAMERA_KNOTS;
  const auto i = static_cast<std::size_t>(std::min(std::floor(x), STOKES_CAMERA_KNOTS - 1.0));
  const double begin = scene.camera_knots[i], end = scene.camera_knots[i + 1];
  result.wavelength.nm = lerp(begin, end, x - static_cast<double>(i));
  result.inverse_pdf = STOKES_CAMERA_KNOTS * (end - begin);
  result.film_weight = sensor_rgb(scene, result.wavelength.nm) * result.inverse_pdf;
  return result;
}

Vec3d sensor_rgb(const CompiledScene& scene, double nm) {
  const auto [cell, f] = cell_at(nm);
  const float* s = &scene.sensor[cell * 8];
  return {lerp(s[0], s[4], f), lerp(s[1], s[5], f), lerp(s[2], s[6], f)};
}

Vec3d sensor_white(const CompiledScene& scene) {
  Vec3d sum;
  for (std::size_t cell = 0; cell < STOKES_SPECTRUM_CELLS; cell++) {
    const float* s = &scene.sensor[cell * 8];
    sum += Vec3d{s[0] + s[4], s[1] + s[5], s[2] + s[6]} * 0.5;
  }
  return sum;
}

double spectrum_eval(const CompiledScene& scene, std::uint32_t table, Wavelength w) {
  if (w.channel >= 0) return scene.spectra[std::size_t(table) * STOKES_RGB_STRIDE + static_cast<std::size_t>(w.channel)];
  const auto [cell, f] = cell_at(w.nm);
  const float* ends = &scene.spectra[std::size_t(table) * STOKES_SPECTRUM_STRIDE + 2 * cell];
  return lerp(ends[0], ends[1], f);
}

double distribution_sample(const CompiledScene& scene, std::uint32_t distribution, double u, double& pdf) {
  const layout::Distribution& d = scene.distributions[distribution];
  const float* cells = &scene.cdfs[std::size_t(d.cdf) * STOKES_CDF_STRIDE];
  // The last cell that begins at or below u; cells without mass are never it.
  std::size_t cell = 0;
  for (std::size_t end = STOKES_SPECTRUM_CELLS; end - cell > 1;) {
    const std::size_t middle = (cell + end) / 2;
    (cells[4 * middle] <= static_cast<float>(u) ? cell : end) = middle;
  }
  const double begin = cells[4 * cell], end = cells[4 * cell + 1];
  const double inside = end > begin ? std::clamp((u - begin) / (end - begin), 0.0, 1.0) : 0.5;
  const float* ends = &scene.spectra[std::size_t(d.spectrum) * STOKES_SPECTRUM_STRIDE + 2 * cell];
  const double a = std::max(0.0f, ends[0]), b = std::max(0.0f, ends[1]);
  const double x = sample_linear(a, b, inside);
  pdf = lerp(a, b, x) / d.integral;
  return STOKES_LAMBDA_MIN + static_cast<double>(cell) + x;
}

double distribution_pdf(const CompiledScene& scene, std::uint32_t distribution, double nm) {
  const layout::Distribution& d = scene.distributions[distribution];
  return std::max(0.0, spectrum_eval(scene, d.spectrum, {nm, -1})) / d.integral;
}

}  // namespace stokes::reference
