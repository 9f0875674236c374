// The mouth: two full lips with a vermilion border, philtrum, corners, and the folds around them.
#include "mesh/head_features.h"

namespace stokes {

using namespace sdf;

namespace {

constexpr double kMouthY = -72.4, kMouthHalf = 25.5;

// Height of the border of the vermilion: cupid's bow above, a full arc below.
double lip_border(double x, bool upper) {
  const double u = std::clamp(x / kMouthHalf, 0.0, 1.0);
  if (upper) return kMouthY - 1.0 + 12.6 * (1 - std::pow(u, 1.7)) - 2.2 * bump(x, 6.5);
  return kMouthY - 1.6 - 12.6 * (1 - std::pow(u, 2.1));
}

// The groove between the two columns that run from the columella to the peaks of cupid's bow.
double philtrum(double x, double y) {
  const double along = smooth_step(-64, -60, y) * (1 - smooth_step(-56, -50, y)), half = 5.8 - 0.06 * (y + 61);
  return (0.5 * bump(x, half) - 0.35 * bump(x - half, 3.6)) * along;
}

}  // namespace

double Mouth::operator()(double d, Vec3d p, Vec3d m) const {
  const double x = m.x, y = m.y, z = m.z;
  if (length_squared(m - Vec3d{12, -72, 92}) > 52 * 52) return d;
  const double upper = smooth_min(upper_lip(m), ellipsoid(p, {0, kMouthY + 3.6, 99.4}, {6, 4.4, 5.6}), 4);  // with the tubercle
  d = smooth_min(d, ellipsoid(p, {0, -59, 87}, {16, 10, 13.6}), 8);  // the skin above the lip
  d = carve(d, seat(m), 5);
  d = smooth_min(d, smooth_min(upper, lower_lip(m), 1), 4.5);
  const double front = smooth_step(70, 80, z);
  d += 0.5 * bump(line.distance(x, y), 2.4) * front * (1 - 0.8 * smooth_step(kMouthHalf - 5, kMouthHalf + 2, x));
  // The vermilion stands a small step above the skin, with the white roll as a ridge along its border.
  const double fade = (1 - smooth_step(kMouthHalf - 10, kMouthHalf, x)) * front;
  const double ub = lip_border(x, true), lb = lip_border(x, false);
  d -= 0.5 * (1 - smooth_step(-1.5, 1.5, y - ub)) * smooth_step(-1.5, 1.5, y - lb) * fade;
  d -= 0.4 * bump(y - ub - 0.6, 2.4) * fade;
  d += philtrum(std::abs(p.x), y) * front;
  d += 0.9 * bump(std::hypot(x * 0.4, y + 89), 8) * front;                                  // mentolabial sulcus
  d += 0.6 * bump(nasolabial.distance(x, y), 8) * front;
  return d + 0.6 * bump(std::hypot(x - kMouthHalf - 1.5, y - kMouthY + 0.5), 8) * front;        // corner of the mouth
}

double lip_mask(Vec3d p) {
  const double x = std::abs(p.x);
  return (1 - smooth_step(-1.2, 0.6, p.y - lip_border(x, true))) * smooth_step(-0.6, 1.2, p.y - lip_border(x, false)) *
         smooth_step(73, 80, p.z) * (1 - smooth_step(kMouthHalf - 2, kMouthHalf + 1, x));
}

}  // namespace stokes
