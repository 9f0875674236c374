// FLIP for low dynamic range: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", 2020. Colour and feature pipelines with the paper's constants; names follow the paper.
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace stokes {
namespace {

using Plane = std::vector<double>;
using Planes = std::array<Plane, 3>;
using Color = std::array<double, 3>;

constexpr double kPi = std::numbers::pi;
constexpr Color kWhite = {0.950428545, 1.0, 1.088900371};  // D65 in XYZ

// sRGB's matrices from its chromaticities without rounding: those whose white is kWhite. (The usual ones of seven digits have another
// white, which changes the mean by up to 2e-5.)
Color rgb_to_xyz(const Color& c) {
  constexpr double r = 1 / 12288897.0, x = r / 2, z = r / 6;
  return {x * (10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]), r * (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]),
          z * (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2])};
}
Color xyz_to_rgb(const Color& c) {
  return {3.241003275 * c[0] - 1.537398934 * c[1] - 0.498615861 * c[2], -0.969224334 * c[0] + 1.875930071 * c[1] + 0.041554224 * c[2],
          0.055639423 * c[0] - 0.204011202 * c[1] + 1.057148933 * c[2]};
}
Color rgb_to_ycxcz(const Color& rgb) {
  const Color c = rgb_to_xyz(rgb);
  const double x = c[0] / kWhite[0], y = c[1] / kWhite[1], z = c[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Color ycxcz_to_rgb(const Color& c) {
  const double y = (c[0] + 16) / 116, x = y + c[1] / 500, z = y - c[2] / 200;
  return xyz_to_rgb({x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}
double lab_curve(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
}
/// CIELAB with the Hunt effect: chroma counts less in the dark.
Color rgb_to_hunt_lab(const Color& rgb) {
  const Color c = rgb_to_xyz(rgb);
  const double x = lab_curve(c[0] / kWhite[0]), y = lab_curve(c[1] / kWhite[1]), z = lab_curve(c[2] / kWhite[2]);
  const double l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}
double hyab(const Color& a, const Color& b) { return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

/// Separable convolution with edge pixels repeated; kernels are odd and centred.
Plane convolve(const Plane& in, int width, int height, const std::vector<double>& along_x, const std::vector<double>& along_y) {
  const int rx = static_cast<int>(along_x.size()) / 2, ry = static_cast<int>(along_y.size()) / 2;
  Plane rows(in.size()), out(in.size());
  const auto at = [width](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x); };
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      double sum = 0;
      for (int i = -rx; i <= rx; i++) sum += along_x[static_cast<std::size_t>(i + rx)] * in[at(std::clamp(x + i, 0, width - 1), y)];
      rows[at(x, y)] = sum;
    }
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      double sum = 0;
      for (int i = -ry; i <= ry; i++) sum += along_y[static_cast<std::size_t>(i + ry)] * rows[at(x, std::clamp(y + i, 0, height - 1))];
      out[at(x, y)] = sum;
    }
  return out;
}

/// The eye's contrast sensitivity as blur: a sum of two Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees, of sum 1.
Plane filter_contrast(const Plane& in, int width, int height, double a1, double b1, double a2, double b2, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
  const double a[2] = {a1, a2}, b[2] = {b1, b2};
  Plane out(in.size(), 0.0);
  double total = 0;
  for (int g = 0; g < 2; g++) {
    if (a[g] == 0) continue;
    std::vector<double> kernel;
    double sum = 0;
    for (int i = -radius; i <= radius; i++) {
      kernel.push_back(std::exp(-kPi * kPi * (i / pixels_per_degree) * (i / pixels_per_degree) / b[g]));
      sum += kernel.back();
    }
    const double weight = a[g] * std::sqrt(kPi / b[g]);
    const Plane blurred = convolve(in, width, height, kernel, kernel);
    for (std::size_t i = 0; i < out.size(); i++) out[i] += weight * blurred[i];
    total += weight * sum * sum;
  }
  for (double& v : out) v /= total;
  return out;
}

/// The image as the eye's filters pass it, back in linear RGB within [0, 1], then in Hunt-adjusted CIELAB.
std::vector<Color> perceived_colors(const Planes& ycxcz, int width, int height, double ppd) {
  const Planes filtered = {filter_contrast(ycxcz[0], width, height, 1, 0.0047, 0, 1e-5, ppd),
                           filter_contrast(ycxcz[1], width, height, 1, 0.0053, 0, 1e-5, ppd),
                           filter_contrast(ycxcz[2], width, height, 34.1, 0.04, 13.5, 0.025, ppd)};
  std::vector<Color> out(ycxcz[0].size());
  for (std::size_t i = 0; i < out.size(); i++) {
    Color rgb = ycxcz_to_rgb({filtered[0][i], filtered[1][i], filtered[2][i]});
    for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
    out[i] = rgb_to_hunt_lab(rgb);
  }
  return out;
}

/// Divides the positive and the negative weights by their own sums.
void normalise_halves(std::vector<double>& kernel) {
  double positive = 0, negative = 0;
  for (const double v : kernel) (v > 0 ? positive : negative) += v;
  for (double& v : kernel) v /= v > 0 ? positive : -negative;
}

/// Strength of edges (first derivative) or points (second derivative) in the achromatic channel.
Plane features(const Plane& luminance, int width, int height, double ppd, bool points) {
  const double sd = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  std::vector<double> gauss, derivative;
  double sum = 0;
  for (int i = -radius; i <= radius; i++) {
    const double g = std::exp(-i * i / (2 * sd * sd));
    gauss.push_back(g);
    sum += g;
    derivative.push_back((points ? i * i / (sd * sd) - 1 : -i) * g);
  }
  for (double& g : gauss) g /= sum;
  normalise_halves(derivative);
  const Plane dx = convolve(luminance, width, height, derivative, gauss), dy = convolve(luminance, width, height, gauss, derivative);
  Plane strength(luminance.size());
  for (std::size_t i = 0; i < strength.size(); i++) strength[i] = std::hypot(dx[i], dy[i]);
  return strength;
}

/// R, G, B of an image clipped to [0, 1], in the opponent space.
Planes opponent_planes(const Image& image) {
  const Image::Channel* rgb[3] = {image.find("R"), image.find("G"), image.find("B")};
  Planes planes;
  for (Plane& plane : planes) plane.resize(rgb[0]->values.size());
  for (std::size_t i = 0; i < planes[0].size(); i++) {
    Color color;
    for (std::size_t c = 0; c < 3; c++) {
      const double v = static_cast<double>(rgb[c]->values[i]);
      color[c] = std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : 0.0;
    }
    const Color opponent = rgb_to_ycxcz(color);
    for (std::size_t c = 0; c < 3; c++) planes[c][i] = opponent[c];
  }
  return planes;
}

/// Compresses large colour differences: up to 0.4 of the largest possible they take 0.95 of the range.
double redistribute(double difference, double largest) {
  constexpr double qc = 0.7, pc = 0.4, pt = 0.95;
  const double error = std::pow(difference, qc), knee = pc * largest;
  return error < knee ? error * pt / knee : pt + (error - knee) / (largest - knee) * (1 - pt);
}

}  // namespace

double flip_difference(const Image& reference, const Image& test, double ppd) {
  const int width = reference.width, height = reference.height;
  const Planes a = opponent_planes(reference), b = opponent_planes(test);
  const std::vector<Color> color_a = perceived_colors(a, width, height, ppd), color_b = perceived_colors(b, width, height, ppd);
  const double largest = std::pow(hyab(rgb_to_hunt_lab({0, 1, 0}), rgb_to_hunt_lab({0, 0, 1})), 0.7);

  Plane grey_a(a[0]), grey_b(b[0]);
  for (double& v : grey_a) v = (v + 16) / 116;
  for (double& v : grey_b) v = (v + 16) / 116;
  const Plane edges_a = features(grey_a, width, height, ppd, false), edges_b = features(grey_b, width, height, ppd, false);
  const Plane points_a = features(grey_a, width, height, ppd, true), points_b = features(grey_b, width, height, ppd, true);

  double sum = 0;
  for (std::size_t i = 0; i < color_a.size(); i++) {
    const double color = redistribute(hyab(color_a[i], color_b[i]), largest);
    const double feature = std::max(std::fabs(edges_a[i] - edges_b[i]), std::fabs(points_a[i] - points_b[i]));
    sum += std::pow(color, 1 - std::min(1.0, std::sqrt(feature / std::numbers::sqrt2)));
  }
  return color_a.empty() ? 0 : sum / static_cast<double>(color_a.size());
}

}  // namespace stokes
