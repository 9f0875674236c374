// Measured reradiation matrices: the kernel, its integral over the incoming wavelength, and exact sampling of it. See fluorescence.h.
#include <cmath>

#include "reference/fluorescence.h"

namespace stokes::reference {
namespace {

/// K along the grid's columns at one outgoing wavelength; linear between the columns.
class Row {
 public:
  Row(const CompiledScene& scene, const layout::Reradiation& m, double lo) : matrix_(m) {
    const double y = (lo - m.lo_min) / m.lo_step;
    if (!(y >= 0) || !(y <= m.rows - 1.0)) return;
    const double low = std::min(std::floor(y), std::max(0.0, m.rows - 2.0));
    fraction_ = m.rows > 1 ? y - low : 0;
    low_ = &scene.reradiation_values[m.offset + static_cast<std::size_t>(low) * m.columns];
    high_ = m.rows > 1 ? low_ + m.columns : low_;
  }
  double at(std::uint32_t column) const { return low_ ? (1 - fraction_) * low_[column] + fraction_ * high_[column] : 0; }
  /// The integral between two neighbouring columns.
  double segment(std::uint32_t column) const { return 0.5 * (at(column) + at(column + 1)) * matrix_.li_step; }
  std::uint32_t segments() const { return low_ ? matrix_.columns - 1 : 0; }

 private:
  const layout::Reradiation& matrix_;
  const float *low_ = nullptr, *high_ = nullptr;
  double fraction_ = 0;
};

}  // namespace

double reradiation_kernel(const CompiledScene& scene, const layout::Reradiation& m, double li, double lo) {
  const Row row(scene, m, lo);
  const double x = (li - m.li_min) / m.li_step;
  if (row.segments() == 0 || !(x >= 0) || !(x <= m.columns - 1.0)) return 0;
  const auto column = static_cast<std::uint32_t>(std::min(std::floor(x), m.columns - 2.0));
  const double f = x - column;
  return (1 - f) * row.at(column) + f * row.at(column + 1);
}

double reradiation_gain(const CompiledScene& scene, const layout::Reradiation& m, double lo) {
  const Row row(scene, m, lo);
  double sum = 0;
  for (std::uint32_t c = 0; c < row.segments(); c++) sum += row.segment(c);
  return sum;
}

Excitation reradiation_sample(const CompiledScene& scene, const layout::Reradiation& m, double lo, double u) {
  const Row row(scene, m, lo);
  const double gain = reradiation_gain(scene, m, lo);
  double left = u * gain;
  for (std::uint32_t c = 0; c < row.segments(); c++) {
    const double mass = row.segment(c);
    if (mass <= 0 || left >= mass) {
      left -= mass;
      continue;
    }
    // Inside the segment the density runs linearly from a to b.
    const double a = row.at(c), b = row.at(c + 1), v = left / mass;
    const double x = a == b ? v : (std::sqrt(a * a + v * (b * b - a * a)) - a) / (b - a);
    return {m.li_min + (c + x) * m.li_step, gain};
  }
  return {};
}

}  // namespace stokes::reference
