// The density of camera wavelengths, as a piecewise linear inverse of its cumulative function.
#include <algorithm>
#include <cmath>

#include "spectral/cie.h"

namespace stokes {
namespace {

// The film sees from 360 nm on, where the colour matching functions begin.
constexpr double kVisibleMin = 360;
// The share of samples spread evenly over the visible range. It bounds the weight of quantities that are not colours (energies).
constexpr double kEvenShare = 1.0 / 32;

// For a spectrum of even brightness, the sum of the variances of R, G and B is least if the density is the norm of the sensor's three
// values (the weight of a sample then has the same length everywhere). Values at the cells' ends, integrating to 1.
CellEnds sensor_density() {
  const auto& xyz = cie_cells().xyz;
  CellEnds density;
  double integral = 0;
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    density[i] = length(xyz_to_rgb(xyz[i]));
    integral += density[i] / 2;
  }
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    const bool visible = kLambdaMin + i / 2 >= kVisibleMin;
    density[i] = (1 - kEvenShare) * density[i] / integral + (visible ? kEvenShare / (kLambdaMax - kVisibleMin) : 0);
  }
  return density;
}

void mix_uniform(CellEnds& density, double begin, double end) {
  begin = std::max(begin, kLambdaMin);
  end = std::min(end, kLambdaMax);
  if (end <= begin) return;
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    const double cell = kLambdaMin + i / 2;
    const double covered = std::max(0.0, std::min(end, cell + 1) - std::max(begin, cell));
    density[i] = (density[i] + covered / (end - begin)) / 2;
  }
}

}  // namespace

std::vector<float> camera_knots(int segments, int bins, double begin, double end) {
  CellEnds density = sensor_density();
  if (bins > 0) mix_uniform(density, begin, end);
  SpectrumTable table;
  std::copy(density.begin(), density.end(), table.begin());
  const TableDistribution distribution = make_distribution(table);
  std::vector<float> knots(segments + 1);
  for (int i = 1; i < segments; i++) knots[i] = float(sample_distribution(table, distribution, i / double(segments)));
  knots.front() = float(bins > 0 ? std::clamp(begin, kLambdaMin, kVisibleMin) : kVisibleMin);
  knots.back() = float(kLambdaMax);
  return knots;
}

}  // namespace stokes
