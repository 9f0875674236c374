// Measured reradiation matrices: noise and energy put right, the diagonal taken apart, densities of the excitation.
#include <algorithm>
#include <cmath>

#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

struct Grid {
  double begin, step;
  std::size_t count;
  double at(std::size_t i) const { return begin + step * double(i); }
};

Grid regular_grid(const Compilation& c, const std::vector<double>& bands, const std::string& pointer) {
  if (bands.size() < 2) c.fail(pointer, "the matrix needs at least two bands each way");
  const double step = (bands.back() - bands.front()) / double(bands.size() - 1);
  for (std::size_t i = 0; i < bands.size(); i++)
    if (!(step > 0) || std::abs(bands[i] - bands.front() - step * double(i)) > 1e-6 * step) c.fail(pointer, "the matrix's bands must be equally spaced");
  return {bands.front(), step, bands.size()};
}

// Piecewise linear through (grid, values), and beyond its ends held or zero.
Curve curve_through(const Spectra& s, const Grid& grid, const std::vector<double>& values, bool hold) {
  Curve curve(s.size());
  const double last = double(grid.count - 1);
  for (std::size_t i = 0; i < curve.size(); i++) {
    const double x = (s.wavelength(i) - grid.begin) / grid.step;
    if ((x < 0 || x > last) && !hold) continue;
    const double inside = std::clamp(x, 0.0, last);
    const auto k = std::min(std::size_t(inside), grid.count - 2);
    const double f = inside - double(k);
    curve[i] = values[k] * (1 - f) + values[k + 1] * f;
  }
  return curve;
}

// Negative noise becomes zero; a column that gives off more than it receives is scaled down to 1.
std::vector<double> clean(Compilation& c, const ReradiationMatrix& m, const std::string& pointer) {
  std::vector<double> v = m.values;
  for (double& x : v) {
    if (!std::isfinite(x)) c.fail(pointer, "the matrix has a value that is not finite");
    x = std::max(x, 0.0);
  }
  double worst = 1;
  std::size_t scaled = 0;
  for (std::size_t column = 0; column < m.li.size(); column++) {
    double sum = 0;
    for (std::size_t row = 0; row < m.lo.size(); row++) sum += v[row * m.li.size() + column];
    if (sum <= 1 + 1e-6) continue;
    for (std::size_t row = 0; row < m.lo.size(); row++) v[row * m.li.size() + column] /= sum;
    scaled++;
    worst = std::max(worst, sum);
  }
  if (scaled)
    c.warn((m.filename.empty() ? pointer : m.filename) + ": " + std::to_string(scaled) + " columns gave off more energy than they received (up to " +
           std::to_string(worst) + ") and were scaled to 1");
  return v;
}

// Takes the diagonal out of `values`; the albedo at each incoming band.
std::vector<double> take_diagonal(const Grid& li, const Grid& lo, std::vector<double>& values) {
  std::vector<double> albedo(li.count, 0.0);
  for (std::size_t column = 0; column < li.count; column++) {
    const auto row = std::ptrdiff_t(std::lround((li.at(column) - lo.begin) / lo.step));
    if (row < 0 || row >= std::ptrdiff_t(lo.count) || std::abs(lo.at(std::size_t(row)) - li.at(column)) > 1e-3 * lo.step) continue;
    double& value = values[std::size_t(row) * li.count + column];
    albedo[column] = value;
    value = 0;
  }
  return albedo;
}

}  // namespace

std::uint32_t compile_reradiation(Compilation& c, const ReradiationMatrix& m, const std::string& pointer, Curve& albedo) {
  const Grid li = regular_grid(c, m.li, pointer), lo = regular_grid(c, m.lo, pointer);
  if (m.values.size() != li.count * lo.count) c.fail(pointer, "the matrix has another number of values than its bands ask for");
  std::vector<double> values = clean(c, m, pointer);
  albedo = curve_through(c.spectra, li, take_diagonal(li, lo, values), true);

  layout::Reradiation out{};
  out.offset = std::uint32_t(c.out.reradiation_values.size());
  out.columns = std::uint32_t(li.count);
  out.rows = std::uint32_t(lo.count);
  out.li_min = float(li.begin), out.li_step = float(li.step);
  out.lo_min = float(lo.begin), out.lo_step = float(lo.step);
  for (double v : values) c.out.reradiation_values.push_back(float(v / lo.step));

  // A row's density covers its neighbours, which the bilinear lookup reaches from anywhere nearest to this row.
  out.first_excitation = std::uint32_t(c.out.distributions.size());
  for (std::size_t row = 0; row < lo.count; row++) {
    std::vector<double> smoothed(li.count);
    for (std::size_t column = 0; column < li.count; column++) {
      const auto at = [&](std::size_t r) { return values[std::min(r, lo.count - 1) * li.count + column]; };
      smoothed[column] = (at(row ? row - 1 : 0) + 2 * at(row) + at(row + 1)) / 4;
    }
    reserve_excitation(c, curve_through(c.spectra, li, smoothed, false));
  }
  c.out.reradiations.push_back(out);
  return std::uint32_t(c.out.reradiations.size() - 1);
}

}  // namespace stokes::compiled
