// Upsampled spectra of very many colours: a grid over the colours whose points are fitted when first needed, and interpolated.
// Knows colours, not images.
#pragma once
#include <array>
#include <vector>

#include "math/vec.h"

namespace stokes::compiled {

/// The grid is that of Jakob & Hanika 2019: one box per largest channel, the other two as fractions of it, and the largest channel
/// itself spaced densely near 0 and 1.
class UpsamplingGrid {
 public:
  UpsamplingGrid();
  /// The sigmoid's coefficients for `rgb` in [0, 1]; the colour they give is within a few thousandths of it. A colour whose largest
  /// channel is below kDarkest gets those of its hue at kDarkest, to be scaled down.
  static constexpr double kDarkest = 1e-4;
  std::array<float, 3> coefficients(Vec3d rgb);

 private:
  static constexpr int kFractions = 32, kLevels = 24;
  const std::array<float, 3>& point(int largest, int x, int y, int z);

  std::array<double, kLevels> levels_;
  std::vector<std::array<float, 3>> points_;
  std::vector<bool> fitted_;
};

}  // namespace stokes::compiled
