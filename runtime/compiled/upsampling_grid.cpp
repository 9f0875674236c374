// See upsampling_grid.h.
#include "compiled/upsampling_grid.h"

#include <algorithm>
#include <cmath>

#include "spectral/tabulate.h"

namespace stokes::compiled {
namespace {

double smoothstep(double x) { return x * x * (3 - 2 * x); }

// The sigmoid's argument at value v. A grey's coefficients are (0, 0, this), and others follow it closely, so that interpolating along
// it is far better than along v.
double argument(double v) {
  v = std::min(v, 0.9999);
  return (2 * v - 1) / (2 * std::sqrt(v * (1 - v)));
}

}  // namespace

UpsamplingGrid::UpsamplingGrid() : points_(3 * kFractions * kFractions * kLevels), fitted_(points_.size(), false) {
  for (int i = 0; i < kLevels; i++) levels_[std::size_t(i)] = smoothstep(double(i) / (kLevels - 1));
  levels_[0] = kDarkest;
}

const std::array<float, 3>& UpsamplingGrid::point(int largest, int x, int y, int z) {
  const auto index = std::size_t(((largest * kLevels + z) * kFractions + y) * kFractions + x);
  if (!fitted_[index]) {
    double rgb[3];
    const double level = levels_[std::size_t(z)];
    rgb[largest] = level;
    rgb[(largest + 1) % 3] = level * x / (kFractions - 1);
    rgb[(largest + 2) % 3] = level * y / (kFractions - 1);
    points_[index] = fit_sigmoid({rgb[0], rgb[1], rgb[2]});
    fitted_[index] = true;
  }
  return points_[index];
}

std::array<float, 3> UpsamplingGrid::coefficients(Vec3d rgb) {
  const int largest = rgb.x >= rgb.y && rgb.x >= rgb.z ? 0 : rgb.y >= rgb.z ? 1 : 2;
  const double level = std::clamp(rgb[largest], kDarkest, 1.0);
  const double scale = rgb[largest] > 0 ? (kFractions - 1) / rgb[largest] : 0;
  const double fx = rgb[(largest + 1) % 3] * scale, fy = rgb[(largest + 2) % 3] * scale;
  const int x = std::min(int(fx), kFractions - 2), y = std::min(int(fy), kFractions - 2);
  const int z = std::clamp(int(std::upper_bound(levels_.begin(), levels_.end(), level) - levels_.begin()) - 1, 0, kLevels - 2);
  const double wx = fx - x, wy = fy - y;
  const double below = argument(levels_[std::size_t(z)]), above = argument(levels_[std::size_t(z + 1)]);
  const double wz = (argument(level) - below) / (above - below);

  std::array<double, 3> sum{};
  for (int corner = 0; corner < 8; corner++) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight = (i ? wx : 1 - wx) * (j ? wy : 1 - wy) * (k ? wz : 1 - wz);
    if (weight == 0) continue;
    const auto& c = point(largest, x + i, y + j, z + k);
    for (std::size_t n = 0; n < 3; n++) sum[n] += weight * double(c[n]);
  }
  return {float(sum[0]), float(sum[1]), float(sum[2])};
}

}  // namespace stokes::compiled
