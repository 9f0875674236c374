// The environment map: upsampled texels and the tables that directions are drawn from.
#include <cmath>
#include <numbers>

#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

// What the power of texel (x, y) is taken to be: the mean over its neighbours, so that a bilinear lookup finds no light where the
// density is zero. Wraps in longitude.
double smoothed_power(const ImagePixels& image, int x, int y) {
  double sum = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height - 1); j++)
    for (int i = x - 1; i <= x + 1; i++) {
      const float* p = &image.rgb[3 * (std::size_t(j) * std::size_t(image.width) + std::size_t((i + image.width) % image.width))];
      for (int k = 0; k < 3; k++) sum += std::isfinite(p[k]) && p[k] > 0 ? double(p[k]) * (i == x && j == y ? 4 : 1) : 0;
    }
  return sum;
}

// A CDF of weights.size() + 1 entries from 0 to exactly 1; uniform when all weights are zero. Returns the weights' sum.
double append_cdf(std::vector<float>& out, const std::vector<double>& weights) {
  double total = 0, sum = 0;
  for (double w : weights) total += w;
  out.push_back(0);
  for (std::size_t i = 0; i < weights.size(); i++) {
    sum += total > 0 ? weights[i] / total : 1.0 / double(weights.size());
    out.push_back(i + 1 == weights.size() ? 1.0f : float(std::min(sum, 1.0)));
  }
  return total;
}

void append_cdfs(Compilation& c, const ImagePixels& image) {
  std::vector<double> rows;
  std::vector<float> columns;
  for (int y = 0; y < image.height; y++) {
    const double sine = std::sin(std::numbers::pi * (y + 0.5) / image.height);
    std::vector<double> weights;
    for (int x = 0; x < image.width; x++) weights.push_back(smoothed_power(image, x, y));
    rows.push_back(append_cdf(columns, weights) * sine);
  }
  append_cdf(c.out.environment_cdf, rows);
  c.out.environment_cdf.insert(c.out.environment_cdf.end(), columns.begin(), columns.end());
}

// The mean colour over the sphere, each row by its solid angle.
Vec3d mean_color(const ImagePixels& image) {
  Vec3d sum;
  double weight = 0;
  for (int y = 0; y < image.height; y++) {
    const double sine = std::sin(std::numbers::pi * (y + 0.5) / image.height);
    for (int x = 0; x < image.width; x++) {
      const float* p = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
      const auto channel = [&](int k) { return std::isfinite(p[k]) ? std::max(double(p[k]), 0.0) : 0.0; };
      sum += Vec3d{channel(0), channel(1), channel(2)} * sine;
      weight += sine;
    }
  }
  return sum / weight;
}

}  // namespace

Curve compile_environment(Compilation& c) {
  const BackgroundDescription& background = c.scene.background;
  const ImagePixels& image = *background.environment;
  if (image.width <= 0 || image.height <= 0) c.fail(background.pointer, "the image has no pixels");
  if (!(background.scale >= 0) || !std::isfinite(background.scale)) c.fail(background.pointer, "the scale must not be negative");
  const Texels texels = append_texels(c, image, TextureUse::Emission);
  layout::Environment& out = c.out.environment;
  out.image_offset = texels.offset;
  out.width = std::uint32_t(image.width);
  out.height = std::uint32_t(image.height);
  out.scale = float(background.scale);

  // Turning the image by an angle about +y turns world directions back by it.
  const double angle = background.rotate * std::numbers::pi / 180, cosine = std::cos(angle), sine = std::sin(angle);
  const double to_local[9] = {cosine, 0, -sine, 0, 1, 0, sine, 0, cosine};
  for (int i = 0; i < 9; i++) out.to_local[i] = float(to_local[i]);

  Spectrum white, mean;
  white.value = 1;
  out.illuminant = c.spectra.add(white, SpectrumRole::Emission);
  append_cdfs(c, image);
  const double peak = std::max({texels.peak.x, texels.peak.y, texels.peak.z}) * background.scale;
  c.peak_radiance = std::max(c.peak_radiance, 2 * peak);  // upsampled spectra of saturated colours exceed their channels

  mean.kind = SpectrumKind::Rgb;
  mean.rgb = mean_color(image) * background.scale;
  return c.spectra.curve(mean, SpectrumRole::Emission);
}

}  // namespace stokes::compiled
