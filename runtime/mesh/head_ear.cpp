// The ear: a plate with a rolled rim (helix), the antihelix and its crus, concha, tragus, antitragus and lobe.
#include <numbers>

#include "mesh/head_features.h"

namespace stokes {

using namespace sdf;

SplineTube Ear::make_helix(bool wall) {
  std::vector<TubePoint> rim = {{1, -2, 1.0, 1.8},    {-6, 2, 2.8, 2.3},    {-10.5, 9, 3.6, 2.7}, {-9.5, 18, 4.4, 2.8},
                                {-2, 26.0, 4.8, 2.9}, {8, 28.0, 4.8, 2.9},  {16, 22, 4.8, 2.9},   {19.3, 11, 4.8, 2.8},
                                {18.8, 0, 4.2, 2.6},  {15.5, -11, 3.4, 2.4}, {10, -20, 2.4, 2.2},  {4, -26, 1.6, 2.2}};
  if (!wall) return SplineTube(rim);
  rim.erase(rim.begin(), rim.begin() + 3);  // the wall joins the rim to the plate
  for (TubePoint& p : rim) p = {p.x * 0.97, p.y * 0.98, p.z * 0.3, p.r * 0.95};
  return SplineTube(rim);
}

double Ear::operator()(Vec3d m) const {
  // The ear's own frame: back, up, out.
  const double to_radians = std::numbers::pi / 180, f = 20 * to_radians, t = 12 * to_radians;
  const Vec3d back{std::sin(f), 0, -std::cos(f)}, out{std::cos(f), 0, std::sin(f)}, up{0, 1, 0};
  const Vec3d e = back * std::cos(t) - up * std::sin(t), v = up * std::cos(t) + back * std::sin(t);
  const Vec3d q = m - Vec3d{70, -13, -7};
  if (length_squared(q) > 60 * 60) return length(q) - 40;  // far away: a bound will do
  const Vec3d l{dot(q, e), dot(q, v), dot(q, out)};
  double d = ellipsoid(l, {5.5, 2, 0.2}, {16.5, 27, 3.8}, plate);
  d = smooth_min(d, ellipsoid(l, {-3, -1, -7}, {9, 19, 8}), 5);                    // root
  d = smooth_min(d, ellipsoid(l, {-2, -25, 1.4}, {7.4, 8.7, 3.9}, lobule), 5);
  d = antihelix.join(d, l, 3.5);
  d = crus.join(d, l, 2.5);
  d = antitragus.join(d, l, 3.5);
  d = carve(d, ellipsoid(l, {1.5, -5, 6}, {8.6, 10.5, 7.5}, concha), 2);
  d = carve(d, ellipsoid(l, {-4, -6, 2}, {4, 4.5, 8}), 2);                          // meatus
  d = helix_wall.join(d, l, 3.5);
  d = helix.join(d, l, 3.2);
  return smooth_min(d, ellipsoid(l, {-8, -6.5, 4.4}, {3.4, 5.6, 3.0}, tragus), 3);
}

}  // namespace stokes
