// A spectrum made ready to be evaluated: fits and normalisations done once, with the places where it is not smooth. Internal to
// runtime/spectral.
#pragma once
#include <functional>
#include <vector>

#include "spectral/tabulate.h"

namespace stokes {

/// The side from which a step is looked at.
enum class Side { Left, Right };

struct Curve {
  std::function<double(double lambda, Side side)> value;
  std::vector<double> breaks;  ///< steps and kinks, in no order; a peak narrower than a cell counts as several
};

/// Throws std::domain_error for an unknown illuminant.
Curve make_curve(const Spectrum& s, SpectrumRole role);

/// The cells' ends of a curve. Where a break lies inside a cell, the cell's ends are moved so that its integral is the curve's, and
/// stay within the curve's range of values there.
std::array<double, 2 * kSpectrumCells> sample_cells(const Curve& curve);

}  // namespace stokes
