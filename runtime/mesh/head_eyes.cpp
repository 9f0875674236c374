// Closed eyes: the globe under its lids, the lash line, the crease and the fold under the brow; brows and lashes as masks.
#include "mesh/head_features.h"

namespace stokes {

using namespace sdf;

namespace {

constexpr double kEyeX = 32.5, kEyeZ = 72.8;  // half the interpupillary distance; depth of the eyeball

// Height of the free edge of the closed upper lid over u = (|x| - eye) / 16.
double lid_edge(double u) { return -9.6 + 5.2 * u * u + u; }

}  // namespace

double Eyes::operator()(double d, Vec3d m) const {
  const double x = m.x, y = m.y, gate = smooth_step(55, 68, m.z);
  if (length_squared(m - Vec3d{33, -2, 76}) > 48 * 48) return d;
  d = fold.join(d, m, 7);
  d = smooth_min(d, ellipsoid(m, {kEyeX, -5, kEyeZ - 2}, {16.5, 13, 13.6}), 6);                           // globe under the lower lid
  // The upper lid lies over the globe and ends at the lashes: crisp there, soft under the brow.
  const double u = (x - kEyeX) / 16;
  const double lid = smooth_max(ellipsoid(m, {kEyeX, -1.5, kEyeZ}, {17, 13.2, 15.8}), (lid_edge(u) - y) * 0.86, 1.3);
  d = smooth_min(d, lid, 1.8 + 5 * smooth_step(-6, 5, y));
  d = margin.join(d, m, 1.2);
  d += 0.75 * bump(lash_line.distance(x, y), 2.2) * gate * smooth_step(15, 22, x);
  d += 1.1 * bump(crease.distance(x, y), 3.0) * gate * bump(x - kEyeX - 1, 23);
  return d + 0.6 * bump(lower_crease.distance(x, y), 6) * gate;
}

SplineTube Eyes::make_margin() {
  std::vector<TubePoint> points;
  for (int i = 0; i < 9; i++) {
    const double k = -0.96 + 1.92 * i / 8, y = lid_edge(k) + 0.5;
    const double h = 1 - (16 * k / 17) * (16 * k / 17) - ((y + 1.5) / 13.2) * ((y + 1.5) / 13.2);
    points.push_back({kEyeX + 16 * k, y, kEyeZ - 0.6 + 15.8 * std::sqrt(std::max(h, 0.02)), 1.35 - 0.6 * std::abs(k)});
  }
  return SplineTube(points);
}

double lash_mask(Vec3d p) {
  const double u = (std::abs(p.x) - kEyeX) / 16;
  return bump(p.y - (lid_edge(u) - 0.8), 1.7) * bump(u, 1.08) * smooth_step(58, 66, p.z);
}

double brow_mask(Vec3d p) {
  // An arched band that tapers to the tail, with slanted strokes of hair.
  const double x = std::abs(p.x), u = std::clamp((x - 12) / 44, 0.0, 1.0);
  const double middle = 13 + 16 * u * (1.1 - u) + u, width = 5.6 * (1 - 0.66 * std::pow(u, 1.6));
  const double strokes = 0.5 + 0.5 * std::sin((x * (1.9 - 0.9 * u) - (p.y - middle) * (1.5 - 1.2 * u)) * 2.3 + 1.3 * std::sin(p.y * 1.7 + x));
  return bump(p.y - middle, width) * smooth_step(10, 15, x) * (1 - smooth_step(52, 57, x)) * smooth_step(40, 50, p.z) * (0.55 + 0.45 * strokes);
}

}  // namespace stokes
