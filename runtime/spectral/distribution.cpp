// Tables as probability densities: cumulative tables and exact sampling of the piecewise linear density.
#include <algorithm>
#include <cmath>

#include "spectral/tabulate.h"

namespace stokes {

TableDistribution make_distribution(const SpectrumTable& t) {
  std::array<double, kSpectrumCells + 1> sums{};
  for (int c = 0; c < kSpectrumCells; c++) sums[c + 1] = sums[c] + (std::max(0.0f, t[2 * c]) + std::max(0.0f, t[2 * c + 1])) / 2.0;
  TableDistribution d;
  d.integral = sums.back();
  // Without any mass the table rises evenly, and the integral of 0 tells the caller.
  for (int c = 0; c <= kSpectrumCells; c++) d.cdf[c] = float(d.integral > 0 ? sums[c] / d.integral : c / double(kSpectrumCells));
  return d;
}

double sample_distribution(const SpectrumTable& t, const TableDistribution& d, double u) {
  // The last entry that is not above u begins the cell, so a cell without mass is never chosen.
  const auto above = std::upper_bound(d.cdf.begin(), d.cdf.end(), u, [](double x, float entry) { return x < double(entry); });
  const int c = std::clamp(int(above - d.cdf.begin()) - 1, 0, kSpectrumCells - 1);
  const double v = (u - d.cdf[c]) / (double(d.cdf[c + 1]) - d.cdf[c]);
  const double left = std::max(0.0f, t[2 * c]), right = std::max(0.0f, t[2 * c + 1]);
  if (left + right <= 0) return kLambdaMin + c + v;
  // Solves left x + (right - left) x^2 / 2 = v (left + right) / 2 in the form without cancellation.
  const double root = left + std::sqrt(left * left + v * (right * right - left * left));
  const double x = root > 0 ? v * (left + right) / root : 0;  // 0 / 0 where a density that begins at 0 meets u = 0
  return kLambdaMin + c + std::min(x, 1.0);
}

}  // namespace stokes
