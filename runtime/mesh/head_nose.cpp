// The nose: a bony bridge, a lobule with two domes, alae with their grooves, and nostrils that open downwards.
#include "mesh/head_features.h"

namespace stokes {

using namespace sdf;

double Nose::operator()(double d, Vec3d p, Vec3d m) const {
  if (length_squared(p - Vec3d{0, -22, 88}) > 52 * 52) return d;  // farther than the nose and its blends reach
  d = smooth_min(d, ellipsoid(p, {0, -29, 80}, {17, 26, 18}), 12);  // pyramid
  d = dorsum.join(d, p, 8);
  const double lobule = smooth_min(ellipsoid(p, {0, -37, 104.5}, {10.5, 8.4, 10}), ellipsoid(m, {4.6, -37.2, 107.4}, {6.8, 6.9, 7.2}), 3);
  d = smooth_min(d, lobule, 6);
  d = smooth_min(d, ellipsoid(m, {15.8, -40.6, 95.5}, {6.6, 7.4, 11}, ala), 7);
  d += 0.55 * bump(alar_groove.distance(p.z, p.y), 3.6) * smooth_step(9, 13, m.x) * (1 - smooth_step(20, 25, m.x));
  d = smooth_min(d, capsule(p, {0, -43, 108}, {0, -46.5, 95}, 3.4, 4.4), 8);  // columella
  return carve(d, ellipsoid(m, {8.6, -49, 100}, {3.6, 5.2, 6.2}, nostril), 3);
}

}  // namespace stokes
