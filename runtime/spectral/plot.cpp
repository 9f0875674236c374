// The layout of a plot, drawn on either canvas, and the colours of single wavelengths.
#include "spectral/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "spectral/canvas.h"

namespace stokes {
namespace {

constexpr Ink kText{40, 44, 52}, kFaint{120, 126, 136}, kGrid{225, 228, 233}, kUltraviolet{244, 242, 250};
// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr Ink kCurveInks[] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {0, 0, 0}};
constexpr double kVisibleMin = 380, kVisibleMax = 780;
constexpr int kHistogramBins = 100;

// The plotting area in pixels and the range of values it shows.
struct Frame {
  double left, top, right, bottom, lowest, highest;
  double x(double lambda) const { return left + (right - left) * (lambda - kLambdaMin) / (kLambdaMax - kLambdaMin); }
  double y(double value) const { return bottom - (bottom - top) * (value - lowest) / (highest - lowest); }
};

// The step among 1, 2, 5 times a power of ten that gives about `count` steps.
double nice_step(double range, int count) {
  const double rough = range / count, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * 0.999) return factor * power;
  return 10 * power;
}

std::string number(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", std::abs(v) < 1e-300 ? 0.0 : v);
  return buffer;
}

using Histogram = std::array<double, kHistogramBins>;

// Heights on the curve's own scale: the fraction of the samples per nm, times the curve's integral.
Histogram histogram(const PlotCurve& curve) {
  Histogram h{};
  const double width = (kLambdaMax - kLambdaMin) / kHistogramBins;
  for (const float lambda : curve.samples)
    if (lambda >= kLambdaMin && lambda <= kLambdaMax) h[std::min(int((lambda - kLambdaMin) / width), kHistogramBins - 1)] += 1;
  const double scale = make_distribution(curve.table).integral / (curve.samples.size() * width);
  for (double& v : h) v *= curve.samples.empty() ? 0 : scale;
  return h;
}

Frame frame_of(const Plot& plot, int width, int height) {
  double lowest = 0, highest = 0;
  for (const PlotCurve& curve : plot.curves) {
    for (const float v : curve.table) {
      if (!std::isfinite(v)) continue;
      lowest = std::min(lowest, double(v));
      highest = std::max(highest, double(v));
    }
    for (const double v : histogram(curve)) highest = std::max(highest, v);
  }
  if (highest - lowest <= 0) highest = lowest + 1;
  const double margin = 0.04 * (highest - lowest);
  return {76, plot.title.empty() ? 40.0 : 64.0, width - 24.0, height - 74.0, lowest < 0 ? lowest - margin : 0, highest + margin};
}

void draw_axes(Canvas& canvas, const Plot& plot, const Frame& f) {
  canvas.rectangle(f.x(kLambdaMin), f.top, f.x(kVisibleMin) - f.x(kLambdaMin), f.bottom - f.top, kUltraviolet);
  const double step = nice_step(f.highest - f.lowest, 5);
  for (double i = std::ceil(f.lowest / step); i * step <= f.highest; i++) {
    canvas.rectangle(f.left, f.y(i * step) - 0.5, f.right - f.left, 1, i == 0 ? kFaint : kGrid);
    canvas.text(f.left - 8, f.y(i * step) + 5, number(i * step), Anchor::End, 13, kText);
  }
  for (double lambda = 300; lambda <= kLambdaMax; lambda += 50) {
    canvas.rectangle(f.x(lambda) - 0.5, f.top, 1, f.bottom - f.top, kGrid);
    canvas.text(f.x(lambda), f.bottom + 34, number(lambda), Anchor::Middle, 13, kText);
  }
  // The axis is the spectrum itself: grey where the eye sees nothing.
  canvas.rectangle(f.left, f.bottom + 2, f.right - f.left, 12, kGrid);
  for (double lambda = kVisibleMin; lambda < kVisibleMax; lambda += 2) {
    const Vec3d c = display_colour(lambda + 1) * 255;
    // Each colour reaches to the end and the next covers it, so that no seams show.
    canvas.rectangle(f.x(lambda), f.bottom + 2, f.right - f.x(lambda), 12,
                     {std::uint8_t(std::lround(c.x)), std::uint8_t(std::lround(c.y)), std::uint8_t(std::lround(c.z))});
  }
  canvas.text((f.x(kLambdaMin) + f.x(kVisibleMin)) / 2, f.top + 20, "ultraviolet", Anchor::Middle, 12, kFaint);
  canvas.text((f.left + f.right) / 2, f.bottom + 60, "wavelength (nm)", Anchor::Middle, 13, kText);
  if (!plot.title.empty()) canvas.text(f.left, 28, plot.title, Anchor::Start, 18, kText);
  canvas.text(f.left, f.top - 12, plot.y_label, Anchor::Start, 13, kFaint);
}

void draw_curve(Canvas& canvas, const PlotCurve& curve, const Frame& f, Ink ink) {
  if (!curve.samples.empty()) {
    const Histogram h = histogram(curve);
    const double width = (kLambdaMax - kLambdaMin) / kHistogramBins;
    for (int i = 0; i < kHistogramBins; i++) {
      const double lambda = kLambdaMin + i * width;
      if (h[i] > 0)
        canvas.rectangle(f.x(lambda) + 0.5, f.y(h[i]), f.x(lambda + width) - f.x(lambda) - 1, f.y(0) - f.y(h[i]),
                         {ink.r, ink.g, ink.b, 0.25});
    }
  }
  std::vector<Point> points;
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    // Where cells meet without a step, one point is enough.
    if (i % 2 == 0 && i > 0 && curve.table[i] == curve.table[i - 1]) continue;
    if (std::isfinite(curve.table[i])) points.push_back({f.x(280 + i / 2 + i % 2), f.y(curve.table[i])});
  }
  canvas.polyline(points, 2, ink);
}

// Names with their colours, in the upper right corner; long names are cut.
void draw_legend(Canvas& canvas, const Plot& plot, const Frame& f, const std::vector<Ink>& inks) {
  constexpr double row = 20, swatch = 18;
  std::size_t longest = 0;
  for (const PlotCurve& curve : plot.curves) longest = std::max(longest, curve.name.size());
  if (longest == 0) return;
  const double width = swatch + 20 + 12.0 * double(std::min<std::size_t>(longest, 28)), x = f.right - width - 6;
  canvas.rectangle(x - 6, f.top + 6, width, row * double(plot.curves.size()) + 8, {255, 255, 255, 0.85});
  for (std::size_t i = 0; i < plot.curves.size(); i++) {
    const double y = f.top + 24 + row * double(i);
    canvas.rectangle(x, y - 7, swatch, 3, inks[i]);
    const std::string& name = plot.curves[i].name;
    canvas.text(x + swatch + 8, y, name.size() <= 28 ? name : name.substr(0, 25) + "...", Anchor::Start, 13, kText);
  }
}

void draw_plot(Canvas& canvas, const Plot& plot, int width, int height) {
  const Frame frame = frame_of(plot, width, height);
  std::vector<Ink> inks;
  for (std::size_t i = 0; i < plot.curves.size(); i++) inks.push_back(kCurveInks[i % std::size(kCurveInks)]);
  canvas.rectangle(0, 0, width, height, {255, 255, 255});
  draw_axes(canvas, plot, frame);
  for (std::size_t i = 0; i < plot.curves.size(); i++) draw_curve(canvas, plot.curves[i], frame, inks[i]);
  draw_legend(canvas, plot, frame, inks);
}

double encode_srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

}  // namespace

std::string plot_svg(const Plot& plot, int width, int height) {
  SvgCanvas canvas(width, height);
  draw_plot(canvas, plot, width, height);
  return std::move(canvas).finish();
}

Pixels plot_pixels(const Plot& plot, int width, int height) {
  PixelCanvas canvas(width, height);
  draw_plot(canvas, plot, width, height);
  return std::move(canvas).finish();
}

Vec3d display_colour(double lambda) {
  if (lambda <= kVisibleMin || lambda >= kVisibleMax) return {};
  Vec3d rgb = max(xyz_to_rgb(cie_xyz(lambda)), {0, 0, 0});
  rgb = rgb / std::max({rgb.x, rgb.y, rgb.z});
  const double fade = std::min({1.0, (lambda - kVisibleMin) / 50, (kVisibleMax - lambda) / 100});
  return {encode_srgb(rgb.x * fade), encode_srgb(rgb.y * fade), encode_srgb(rgb.z * fade)};
}

Pixels wavelength_strip(int width, int height) {
  Pixels strip{width, height, std::vector<std::uint8_t>(std::size_t(3) * width * height)};
  for (int x = 0; x < width; x++) {
    const Vec3d c = display_colour(kLambdaMin + (kLambdaMax - kLambdaMin) * (x + 0.5) / width);
    for (int y = 0; y < height; y++)
      for (int k = 0; k < 3; k++) strip.rgb[3 * (std::size_t(y) * width + x) + k] = std::uint8_t(std::lround(255 * c[k]));
  }
  return strip;
}

}  // namespace stokes
