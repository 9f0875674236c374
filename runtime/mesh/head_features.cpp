// The features of the procedural head. Depths of grooves and heights of ridges are in millimetres.
#include "mesh/head_features.h"

#include <numbers>

namespace stokes {

using namespace sdf;

namespace {

constexpr double kEyeX = 32.5, kEyeZ = 70;               // half the interpupillary distance; depth of the eyeball
constexpr double kMouthY = -72, kMouthHalf = 26.5;
constexpr Vec3d kTip{0, -36.8, 103.2};
constexpr double kNoseHalf = 23;

// Height of the free edge of the closed upper lid over u = (|x| - eye) / 16.
double lid_edge(double u) { return -9.6 + 5.6 * u * u + u; }

// Height of the border of the vermilion: cupid's bow above, a full arc below.
double lip_border(double x, bool upper) {
  const double u = std::clamp(x / kMouthHalf, 0.0, 1.0);
  if (upper) return kMouthY - 1.5 + 14.2 * (1 - std::pow(u, 1.7)) - 2.4 * bump(x, 7);
  return kMouthY - 2.2 - 14 * (1 - std::pow(u, 2.4));
}

}  // namespace

double HeadFeatures::nose(double d, Vec3d p, Vec3d m) const {
  if (length_squared(p - Vec3d{0, -22, 88}) > 52 * 52) return d;  // farther than the nose and its blends reach; likewise below
  const double ty = kTip.y, tz = kTip.z, a = kNoseHalf;
  d = smooth_min(d, ellipsoid(p, {0, -30, 80}, {18.5, 27, 18}), 12);
  d = smooth_min(d, dorsum(p), 8);
  d = smooth_min(d, ellipsoid(p, kTip, {13.2, 9.5, 10.2}), 8);                                              // lobule
  d = smooth_min(d, ellipsoid(m, {a - 6.6, ty - 3.4, tz - 10.5}, {7.0, 7.6, 11.5}, ala), 7);
  d = smooth_min(d, capsule(p, {0, ty - 6.4, tz + 2}, {0, ty - 9, tz - 11}, 4, 5), 7);                      // columella
  return carve(d, ellipsoid(m, {a - 12.2, ty - 12, tz - 6.6}, {4.9, 4.0, 5.4}, nostril), 3.2);
}

double HeadFeatures::lips(double d, Vec3d p, Vec3d m) const {
  const double x = m.x, y = m.y, z = m.z;
  if (length_squared(m - Vec3d{12, -72, 94}) > 52 * 52) return d;
  const double upper = smooth_min(upper_lip(m), ellipsoid(p, {0, kMouthY + 3.4, 102.2}, {6, 4.6, 6.0}), 4);  // with the tubercle
  d = carve(d, lip_seat(m), 5);
  d = smooth_min(d, smooth_min(upper, lower_lip(m), 1), 4.5);
  const double front = smooth_step(70, 80, z);
  d += 0.38 * bump(mouth_line.distance(x, y), 2.2) * front * (1 - 0.8 * smooth_step(kMouthHalf - 5, kMouthHalf + 2, x));
  // The vermilion stands a small step above the skin, with the white roll as a ridge along its border.
  const double fade = (1 - smooth_step(kMouthHalf - 10, kMouthHalf, x)) * front;
  const double ub = lip_border(x, true), lb = lip_border(x, false);
  d -= 0.65 * (1 - smooth_step(-1.3, 1.3, y - ub)) * smooth_step(-1.3, 1.3, y - lb) * fade;
  d -= 0.35 * bump(y - ub - 0.6, 2) * fade;
  // Philtrum: a groove between two columns.
  const double philtrum = smooth_step(kMouthY + 7, kMouthY + 14, y) * (1 - smooth_step(kMouthY + 15, kMouthY + 25, y)) * smooth_step(80, 95, z);
  d += (0.6 * bump(std::abs(p.x), 5.5) - 0.45 * bump(std::abs(p.x) - 6, 3.4)) * philtrum;
  d += 0.8 * bump(std::hypot(x * 0.45, y - (kMouthY - 18.5)), 8) * front;                                     // mentolabial sulcus
  return d + 0.5 * bump(std::hypot(x - kMouthHalf - 2.5, y - kMouthY + 2), 8) * front;                        // corner of the mouth
}

double HeadFeatures::eyes(double d, Vec3d m) const {
  const double x = m.x, y = m.y, gate = smooth_step(55, 68, m.z);
  if (length_squared(m - Vec3d{33, -2, 76}) > 48 * 48) return d;
  d = smooth_min(d, lid_fold(m), 7);
  d = smooth_min(d, ellipsoid(m, {kEyeX, -5, kEyeZ - 1.2}, {16.5, 13.2, 13.2}), 6);                           // globe under the lower lid
  // The upper lid lies over the globe and ends at the lashes: crisp there, soft under the brow.
  const double u = (x - kEyeX) / 16;
  const double lid = smooth_max(ellipsoid(m, {kEyeX, -1, kEyeZ}, {17, 13.6, 15}), (lid_edge(u) - y) * 0.86, 1.1);
  d = smooth_min(d, lid, 1.6 + 5 * smooth_step(-6, 5, y));
  d = smooth_min(d, lid_margin(m), 1);
  d += 0.72 * bump(lash_line.distance(x, y), 1.9) * gate;
  d += 0.95 * bump(lid_crease.distance(x, y), 2.8) * gate * bump(x - kEyeX - 1, 21);
  return d + 0.4 * bump(lower_crease.distance(x, y), 6) * gate;
}

Tube HeadFeatures::make_lid_margin() {
  std::vector<TubePoint> points;
  for (int i = 0; i < 9; i++) {
    const double k = -0.94 + 1.88 * i / 8, y = lid_edge(k) + 0.4;
    const double h = 1 - (16 * k / 17) * (16 * k / 17) - ((y + 1) / 13.6) * ((y + 1) / 13.6);
    points.push_back({kEyeX + 16 * k, y, kEyeZ - 0.5 + 15 * std::sqrt(std::max(h, 0.02)), 1.15 - 0.55 * std::abs(k)});
  }
  return Tube(points, 12);
}

Tube HeadFeatures::make_helix(bool wall) {
  std::vector<TubePoint> rim = {{1, -2, 1.0, 1.8},    {-6, 2, 2.8, 2.3},    {-10.5, 9, 3.6, 2.7}, {-9.5, 18, 4.4, 2.8},
                                {-2, 26.0, 4.8, 2.9}, {8, 28.0, 4.8, 2.9},  {16, 22, 4.8, 2.9},   {19.3, 11, 4.8, 2.8},
                                {18.8, 0, 4.2, 2.6},  {15.5, -11, 3.4, 2.4}, {10, -20, 2.4, 2.2},  {4, -26, 1.6, 2.2}};
  if (!wall) return Tube(rim, 22);
  rim.erase(rim.begin(), rim.begin() + 3);  // the wall joins the rim to the plate
  for (TubePoint& p : rim) p = {p.x * 0.97, p.y * 0.98, p.z * 0.3, p.r * 0.95};
  return Tube(rim, 12);
}

double HeadFeatures::ear(Vec3d m) const {
  // The ear's own frame: back, up, out.
  const double to_radians = std::numbers::pi / 180, f = 20 * to_radians, t = 12 * to_radians;
  const Vec3d back{std::sin(f), 0, -std::cos(f)}, out{std::cos(f), 0, std::sin(f)}, up{0, 1, 0};
  const Vec3d e = back * std::cos(t) - up * std::sin(t), v = up * std::cos(t) + back * std::sin(t);
  const Vec3d q = m - Vec3d{70, -13, -7};
  if (length_squared(q) > 60 * 60) return length(q) - 40;  // far away: a bound will do
  const Vec3d l{dot(q, e), dot(q, v), dot(q, out)};
  double d = ellipsoid(l, {4.5, 2, 0.5}, {15, 26.5, 2.8}, plate);
  d = smooth_min(d, ellipsoid(l, {-3, -1, -7}, {9, 19, 8}), 5);                    // root
  d = smooth_min(d, ellipsoid(l, {-2, -25, 1.6}, {7.2, 8.5, 3.2}, lobule), 4);
  d = smooth_min(d, antihelix(l), 2.5);
  d = smooth_min(d, crus(l), 2.5);
  d = smooth_min(d, antitragus(l), 2.5);
  d = carve(d, ellipsoid(l, {1.5, -5, 6}, {8.6, 10.5, 7.5}, concha), 2);
  d = carve(d, ellipsoid(l, {-4, -6, 2}, {4, 4.5, 8}), 2);                          // meatus
  d = smooth_min(d, helix_wall(l), 2);
  d = smooth_min(d, helix(l), 2);
  return smooth_min(d, ellipsoid(l, {-9.5, -5.5, 3.4}, {3.4, 5.6, 2.8}, tragus), 2.5);
}

double lip_mask(Vec3d p) {
  const double x = std::abs(p.x);
  return (1 - smooth_step(-1.2, 0.6, p.y - lip_border(x, true))) * smooth_step(-0.6, 1.2, p.y - lip_border(x, false)) *
         smooth_step(75, 82, p.z) * (1 - smooth_step(kMouthHalf - 2, kMouthHalf + 1, x));
}

double lash_mask(Vec3d p) {
  const double u = (std::abs(p.x) - kEyeX) / 16;
  return bump(p.y - (-10.4 + 5.8 * u * u + u), 1.7) * bump(u, 1.08) * smooth_step(58, 66, p.z);
}

double brow_mask(Vec3d p) {
  // An arched band that tapers to the tail, with slanted strokes of hair.
  const double x = std::abs(p.x), u = std::clamp((x - 12) / 44, 0.0, 1.0);
  const double middle = 13 + 16 * u * (1.1 - u) + u, width = 5.6 * (1 - 0.66 * std::pow(u, 1.6));
  const double strokes = 0.5 + 0.5 * std::sin((x * (1.9 - 0.9 * u) - (p.y - middle) * (1.5 - 1.2 * u)) * 2.3 + 1.3 * std::sin(p.y * 1.7 + x));
  return bump(p.y - middle, width) * smooth_step(10, 15, x) * (1 - smooth_step(52, 57, x)) * smooth_step(40, 50, p.z) * (0.55 + 0.45 * strokes);
}

}  // namespace stokes
