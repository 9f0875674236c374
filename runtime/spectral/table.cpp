// From curves to the tables of 1 nm cells, and reading these tables.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spectral/curve.h"

namespace stokes {
namespace {

// Gauss-Legendre with 4 points, and the curve between two breaks.
double integrate_piece(const Curve& curve, double a, double b) {
  static constexpr double x[2] = {0.3399810435848563, 0.8611363115940526}, w[2] = {0.6521451548625461, 0.3478548451374538};
  double sum = 0;
  for (int i = 0; i < 2; i++)
    for (const double sign : {-1.0, 1.0}) sum += w[i] * curve.value((a + b) / 2 + sign * x[i] * (b - a) / 2, Side::Right);
  return sum * (b - a) / 2;
}

// Ends of a cell with breaks inside: the line with the curve's integral whose slope is as near to the curve's as its range allows.
void fit_cell(const Curve& curve, double begin, std::vector<double> inside, double& left, double& right) {
  std::sort(inside.begin(), inside.end());
  double lowest = std::min(left, right), highest = std::max(left, right), integral = 0, from = begin;
  for (const double at : inside) {
    for (const Side side : {Side::Left, Side::Right}) {
      lowest = std::min(lowest, curve.value(at, side));
      highest = std::max(highest, curve.value(at, side));
    }
    integral += integrate_piece(curve, from, at);
    from = at;
  }
  integral += integrate_piece(curve, from, begin + 1);
  const double room = std::max(0.0, std::min(integral - lowest, highest - integral));
  const double half_rise = std::clamp((right - left) / 2, -room, room);
  left = integral - half_rise;
  right = integral + half_rise;
}

int cell_of(double lambda) { return std::min(int(lambda - kLambdaMin), kSpectrumCells - 1); }

}  // namespace

std::array<double, 2 * kSpectrumCells> sample_cells(const Curve& curve) {
  std::array<double, 2 * kSpectrumCells> ends;
  for (int i = 0; i < 2 * kSpectrumCells; i++) ends[i] = curve.value(280 + i / 2 + i % 2, i % 2 == 0 ? Side::Right : Side::Left);
  std::array<std::vector<double>, kSpectrumCells> inside;
  for (const double at : curve.breaks)
    if (at > kLambdaMin && at < kLambdaMax && at != std::floor(at)) inside[cell_of(at)].push_back(at);
  for (int c = 0; c < kSpectrumCells; c++)
    if (!inside[c].empty()) fit_cell(curve, kLambdaMin + c, inside[c], ends[2 * c], ends[2 * c + 1]);
  return ends;
}

double evaluate(const Spectrum& s, SpectrumRole role, double lambda) {
  // Nothing lies to the right of the last wavelength.
  return make_curve(s, role).value(lambda, lambda < kLambdaMax ? Side::Right : Side::Left);
}

SpectrumTable tabulate(const Spectrum& s, SpectrumRole role) {
  const auto ends = sample_cells(make_curve(s, role));
  SpectrumTable table;
  for (int i = 0; i < 2 * kSpectrumCells; i++) {
    table[i] = float(ends[i]);
    if (!std::isfinite(table[i])) throw std::domain_error("not finite at " + std::to_string(280 + i / 2 + i % 2) + " nm");
  }
  return table;
}

double table_value(const SpectrumTable& t, double lambda) {
  lambda = std::clamp(lambda, kLambdaMin, kLambdaMax);
  const int c = cell_of(lambda);
  const double f = lambda - kLambdaMin - c, left = t[2 * c], right = t[2 * c + 1];
  return left + f * (right - left);
}

double table_integral(const SpectrumTable& t, double a, double b) {
  a = std::clamp(a, kLambdaMin, kLambdaMax);
  b = std::clamp(b, kLambdaMin, kLambdaMax);
  if (b <= a) return 0;
  double sum = 0;
  for (int c = cell_of(a); c <= cell_of(b); c++) {
    // The part of the cell inside [a, b] is a trapezoid.
    const double begin = std::max(a - kLambdaMin - c, 0.0), end = std::min(b - kLambdaMin - c, 1.0);
    const double left = t[2 * c], right = t[2 * c + 1];
    sum += (end - begin) * (left + (right - left) * (begin + end) / 2);
  }
  return sum;
}

bool is_constant(const SpectrumTable& t, double tolerance) {
  const auto [lowest, highest] = std::minmax_element(t.begin(), t.end());
  return double(*highest) - *lowest <= tolerance * std::max(std::abs(double(*lowest)), std::abs(double(*highest)));
}

}  // namespace stokes
