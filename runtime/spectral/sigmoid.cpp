// Upsampling of colours: Jakob and Hanika, "A low-dimensional function space for efficient spectral upsampling", 2019, fitted here
// per colour by damped Gauss-Newton steps instead of being looked up in their table.
#include "spectral/sigmoid.h"

#include <algorithm>
#include <cmath>

#include "spectral/cie.h"

namespace stokes {
namespace {

// The fit works in s = (lambda - 580) / 200, which is [-1, 1] over the visible range, and so is well conditioned.
constexpr double kCentre = 580, kHalfWidth = 200;
constexpr double kHoldBelow = 380;
constexpr int kMaxNodes = 424;  // 421 rounded up

// A colour is a weighted sum of the sigmoid's values at nodes, here 1 or 5 nm apart from 360 to 780 nm.
struct Quadrature {
  int count = 0;
  double s[kMaxNodes] = {};
  double weight[3][kMaxNodes] = {};
};

// Weights of the value at each whole nanometre: the integrals of hat functions with the sensor, and with D65 within each cell (light
// falls on a reflectance) or at the node (the table of an emission holds the product).
Quadrature nanometre_quadrature(bool emission) {
  const auto& cie = cie_cells().xyz;
  const CellEnds& light = d65_cells();
  Quadrature q;
  q.count = 421;
  for (int i = 0; i < q.count; i++) {
    const int right = 2 * (80 + i);  // the cell that begins at the node
    Vec3d xyz;
    const auto add_half_hat = [&](int near, int far) {
      const double far_light = emission ? light[near] : light[far];
      xyz += (cie[near] * light[near] + (cie[near] + cie[far]) * ((light[near] + far_light) / 2)) / 6;
    };
    if (i > 0) add_half_hat(right - 1, right - 2);
    if (i < 420) add_half_hat(right, right + 1);
    const Vec3d rgb = xyz_to_rgb(xyz);
    q.s[i] = (std::max(360.0 + i, kHoldBelow) - kCentre) / kHalfWidth;
    for (int c = 0; c < 3; c++) q.weight[c][i] = rgb[c];
  }
  return q;
}

Quadrature coarsen(const Quadrature& fine, int step) {
  Quadrature q;
  q.count = 420 / step + 1;
  for (int j = 0; j < q.count; j++) {
    q.s[j] = fine.s[j * step];
    for (int i = std::max(0, (j - 1) * step); i <= std::min(420, (j + 1) * step); i++)
      for (int c = 0; c < 3; c++) q.weight[c][j] += fine.weight[c][i] * (1 - std::abs(i - j * step) / double(step));
  }
  return q;
}

struct Colour {
  Vec3d rgb;
  Vec3d by_square, by_slope, by_constant;  // derivatives by the three coefficients
};

// c = (square, slope, constant) in s.
Colour evaluate_colour(const Quadrature& q, Vec3d c) {
  double value[kMaxNodes], derivative[kMaxNodes];
#pragma omp simd
  for (int i = 0; i < q.count; i++) {
    const double x = (c.x * q.s[i] + c.y) * q.s[i] + c.z;
    const double r = 1 / std::sqrt(1 + x * x);
    value[i] = 0.5 + 0.5 * x * r;
    derivative[i] = 0.5 * r * r * r;
  }
  double sum[3][4];
  for (int k = 0; k < 3; k++) {
    const double* weight = q.weight[k];
    double v = 0, d0 = 0, d1 = 0, d2 = 0;
#pragma omp simd reduction(+ : v, d0, d1, d2)
    for (int i = 0; i < q.count; i++) {
      const double s = q.s[i], wd = weight[i] * derivative[i];
      v += weight[i] * value[i];
      d0 += wd;
      d1 += wd * s;
      d2 += wd * s * s;
    }
    sum[k][0] = v, sum[k][1] = d0, sum[k][2] = d1, sum[k][3] = d2;
  }
  const auto gather = [&](int i) { return Vec3d{sum[0][i], sum[1][i], sum[2][i]}; };
  return {gather(0), gather(3), gather(2), gather(1)};
}

// The step of Levenberg and Marquardt: (J^T J + damping diag(J^T J)) step = -J^T residual.
Vec3d damped_step(const Colour& at, Vec3d residual, double damping) {
  const Vec3d j[3] = {at.by_square, at.by_slope, at.by_constant};
  Affine normal;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) normal.m[4 * a + b] = dot(j[a], j[b]) * (a == b ? 1 + damping : 1) + (a == b ? 1e-18 : 0);
  return normal.inverse().vector({-dot(j[0], residual), -dot(j[1], residual), -dot(j[2], residual)});
}

// Improves `c` until the colour is within `tolerance` of `target`; returns the distance reached.
double refine(const Quadrature& q, Vec3d target, double tolerance, int steps, Vec3d& c) {
  Colour at = evaluate_colour(q, c);
  Vec3d residual = at.rgb - target;
  double damping = 1e-3;
  for (int i = 0; i < steps && length(residual) > tolerance; i++) {
    const Vec3d next = c + damped_step(at, residual, damping);
    const Colour there = is_finite(next) ? evaluate_colour(q, next) : at;
    if (is_finite(next) && length_squared(there.rgb - target) < length_squared(residual)) {
      c = next;
      at = there;
      residual = at.rgb - target;
      damping = std::max(damping * 0.1, 1e-12);
    } else {
      damping = std::max(damping * 10, 1e-6);
      if (damping > 1e12) break;
    }
  }
  return length(residual);
}

double inverse_sigmoid(double value) {
  if (value <= 0) return -1e4;  // the sigmoid is then 0 (1) to the last digit of a float
  if (value >= 1) return 1e4;
  return (value - 0.5) / std::sqrt(value * (1 - value));
}

SigmoidCoefficients in_t(Vec3d c) {
  const double scale = (kLambdaMax - kLambdaMin) / kHalfWidth, shift = (kLambdaMin - kCentre) / kHalfWidth;  // s = scale t + shift
  return {c.x * scale * scale, scale * (2 * c.x * shift + c.y), (c.x * shift + c.y) * shift + c.z};
}

struct Quadratures {
  Quadrature fine, coarse;
  explicit Quadratures(bool emission) : fine(nanometre_quadrature(emission)), coarse(coarsen(fine, 5)) {}
};

SigmoidCoefficients fit(const Quadratures& q, Vec3d target, double tolerance) {
  if (target.x == target.y && target.y == target.z) return {0, 0, inverse_sigmoid(target.x)};
  const Vec3d grey{0, 0, inverse_sigmoid(std::clamp((target.x + target.y + target.z) / 3, 1e-3, 1 - 1e-3))};
  Vec3d c = grey;
  refine(q.coarse, target, 1e-5, 60, c);
  if (refine(q.fine, target, tolerance, 60, c) <= 10 * tolerance) return in_t(c);
  // Stubborn colours are approached from grey, each fit beginning at the one before.
  const double mean = (target.x + target.y + target.z) / 3;
  Vec3d best = c, walk = grey;
  for (double amount = 0.1; amount < 1.05; amount += 0.1)
    refine(q.fine, Vec3d{mean, mean, mean} * (1 - std::min(amount, 1.0)) + target * std::min(amount, 1.0), tolerance, 100, walk);
  const auto error = [&](Vec3d at) { return length_squared(evaluate_colour(q.fine, at).rgb - target); };
  return in_t(error(walk) < error(best) ? walk : best);
}

Vec3d clamped(Vec3d rgb) { return max(min(rgb, {1, 1, 1}), {0, 0, 0}); }

template <typename T>
double sigmoid_at(const std::array<T, 3>& c, double lambda) {
  const double t = (std::max(lambda, kHoldBelow) - kLambdaMin) / (kLambdaMax - kLambdaMin);
  const double x = (c[0] * t + c[1]) * t + c[2];
  return 0.5 + x / (2 * std::sqrt(1 + x * x));
}

}  // namespace

SigmoidCoefficients fit_reflectance(Vec3d rgb) {
  static const Quadratures quadratures(false);
  return fit(quadratures, clamped(rgb), 3e-6);
}

SigmoidCoefficients fit_emission(Vec3d rgb) {
  static const Quadratures quadratures(true);
  return fit(quadratures, clamped(rgb), 1e-10);
}

std::array<float, 3> fit_sigmoid(Vec3d rgb) {
  const SigmoidCoefficients c = fit_reflectance(rgb);
  return {float(c[0]), float(c[1]), float(c[2])};
}

double sigmoid_value(const std::array<float, 3>& c, double lambda) { return sigmoid_at(c, lambda); }
double sigmoid_value(const SigmoidCoefficients& c, double lambda) { return sigmoid_at(c, lambda); }

}  // namespace stokes
