// The palm of the procedural hand.
#include "mesh/hand_palm.h"

namespace stokes {

using namespace sdf;

namespace sdf {

double round_cone(Vec3d q, double r1, double r2, double y0, double y1, double sx, double sz) {
  const double h = y1 - y0, rho = std::hypot(q.x * sx, q.z * sz), y = q.y - y0;
  const double b = (r1 - r2) / h, a = std::sqrt(std::max(1 - b * b, 1e-6)), k = a * y - b * rho;
  if (k < 0) return std::hypot(rho, y) - r1;
  if (k > a * h) return std::hypot(rho, y - h) - r2;
  return a * rho + b * y - r1;
}

namespace {

double cone_between(Vec3d p, Vec3d a, Vec3d b, double ra, double rb) {
  const Vec3d axis = b - a;
  const double h = length(axis), y = dot(p - a, axis) / h, rho = std::sqrt(std::max(length_squared(p - a) - y * y, 0.0));
  return round_cone({rho, y, 0}, ra, rb, 0, h);
}

// The exact distance to a triangle, less r.
double rounded_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c, double r) {
  const Vec3d n = normalize(cross(b - a, c - a));
  double best = 1e30;
  bool inside = true;
  const Vec3d corner[3] = {a, b, c};
  for (int i = 0; i < 3; i++) {
    const Vec3d u = corner[i], e = corner[(i + 1) % 3] - u, d = p - u;
    const double t = std::clamp(dot(d, e) / length_squared(e), 0.0, 1.0);
    best = std::min(best, length_squared(d - e * t));
    inside = inside && dot(d, cross(n, e)) >= 0;
  }
  return (inside ? std::abs(dot(p - a, n)) : std::sqrt(best)) - r;
}

}  // namespace
}  // namespace sdf

HandPalm::HandPalm(const HandSkeleton& skeleton, double arch) : skeleton_(skeleton), arch_(arch) {
  auto crease = [&](std::vector<std::array<double, 2>> points, double depth, double width) {
    lines_.push_back({Curve2(points, 14), depth, width, width > 1.75 ? 0.45 : 0.3, 0.3, 0.75, true});
  };
  crease({{-36, 62}, {-26, 66}, {-7, 70}, {8, 79}, {13, 90}}, 0.55, 1.8);   // distal
  crease({{36, 73}, {22, 69}, {2, 59}, {-20, 44}}, 0.52, 1.8);              // proximal
  crease({{36, 72}, {23, 65}, {9.5, 49}, {5, 31}, {8, 12}}, 0.62, 1.9);     // thenar
  crease({{-25, 4}, {-10, 0}, {4, 1}, {20, 4}}, 0.42, 1.7);                 // wrist, distal
  crease({{-17, -7}, {0, -9}, {20, -5}}, 0.20, 1.6);                        // wrist, proximal
  for (const Digit& d : skeleton_.fingers) {                                // extensor tendons
    const Vec3d k = d.bones[0].origin;
    lines_.push_back({Curve2({{k.x * 0.22, 8}, {k.x, k.y + 2}}, 1), -0.6, 4.5, 0, 0.6, 0.8, false});
  }
  for (const std::vector<std::array<double, 2>>& vein : {std::vector<std::array<double, 2>>{{20, 10}, {17, 32}, {11, 48}, {11, 64}, {16, 80}},
                                                         {{-18, 8}, {-17, 30}, {-21, 48}, {-21, 70}},
                                                         {{-18, 34}, {-9, 46}, {-4, 62}, {-4, 76}}})
    lines_.push_back({Curve2(vein, 12), -0.40, 3.6, 0, 0.3, 0.7, false});
}

double HandPalm::flesh(Vec3d p) const {
  // Forearm: two bones and the head of the ulna.
  double d = smooth_min(cone_between(p, {15, -60, -1}, {9.5, 34, 0}, 19.5, 14), cone_between(p, {-14, -60, -1}, {-11, 34, 0}, 19, 13), 16);
  d = smooth_min(d, ellipsoid(p, {-16, -13, -12}, {8.5, 12, 6.5}), 9);
  double metacarpals = 1e30;
  for (int f = 0; f < 4; f++) {
    const double m = cone_between(p, kFingers[f].cmc, skeleton_.fingers[f].bones[0].origin, 13, kFingers[f].radii[0] * 1.03);
    metacarpals = f == 0 ? m : smooth_min(metacarpals, m, 11);
  }
  d = smooth_min(d, metacarpals, 18);
  // The flat back of the hand between the metacarpals.
  const Vec3d a = kFingers[0].cmc, b = kFingers[3].cmc, down{0, 8, 0};
  const Vec3d index = skeleton_.fingers[0].bones[0].origin - down, little = skeleton_.fingers[3].bones[0].origin - down;
  d = smooth_min(d, rounded_triangle(p, a, index, little, 10.6), 4);
  d = smooth_min(d, rounded_triangle(p, a, b, little, 10.6), 4);
  for (const Digit& f : skeleton_.fingers) d = smooth_min(d, ellipsoid(f.bones[0].local(p), {0, -1, -4.6}, {7.4, 10, 6.0}), 8);  // knuckles
  return d;
}

double HandPalm::eminences(double d, Vec3d p) const {
  Vec3d row[4];
  for (int f = 0; f < 4; f++) row[f] = skeleton_.fingers[f].bones[0].origin + Vec3d{0, -5, 5.0};
  row[3].x += 2.5;
  const double pads[3] = {9.2, 9.0, 8.4};
  for (int f = 0; f < 3; f++) d = smooth_min(d, cone_between(p, row[f], row[f + 1], pads[f], pads[f] - 0.3), 9);
  // Hypothenar: from the pisiform along the little finger's rim.
  const Vec3d rim{-22, 40, 6.5 + 0.5 * arch_};
  d = smooth_min(d, cone_between(p, {-16.5, 12, 5}, rim, 12.4, 12.6), 12);
  d = smooth_min(d, cone_between(p, rim, skeleton_.fingers[3].bones[0].origin + Vec3d{4, -9, 3}, 12.4, 11), 12);
  // Thenar: the belly along the thumb's metacarpal, on its palm side.
  const Bone& m = skeleton_.thumb.bones[0];
  d = smooth_min(d, ellipsoid(m.local(p), {-5.5, m.length * 0.42, 7}, {14.5, m.length * 0.62, 14.5}), 9);
  return smooth_min(d, cone_between(p, {11, 10, 6}, m.world({-3, m.length * 0.4, 3}), 12.5, 13), 12);
}

double HandPalm::webs(double d, Vec3d p) const {
  // The first web: thick at the palm, a thin sheet towards its edge.
  const Bone& m = skeleton_.thumb.bones[0];
  const Vec3d a = kFingers[0].cmc, far = a + (skeleton_.fingers[0].bones[0].origin - a) * 0.86;
  const Vec3d thumb = skeleton_.thumb.bones[1].world({-2, 3, -1});
  d = smooth_min(d, rounded_triangle(p, a + Vec3d{4, 4, 4}, m.world({-2, m.length * 0.62, 0}), far + Vec3d{0, -8, 2}, 7), 9);
  d = smooth_min(d, rounded_triangle(p, a + Vec3d{4, 20, 2}, thumb, far + Vec3d{-3, -1, 0}, 4.5), 16);
  for (int f = 0; f < 3; f++) {
    const Bone &l = skeleton_.fingers[f].bones[0], &r = skeleton_.fingers[f + 1].bones[0];
    d = smooth_min(d, cone_between(p, l.world({0, l.length * 0.30, 1.5}), r.world({0, r.length * 0.30, 1.5}), 6.6, 6.2), 6);
  }
  return d;
}

double HandPalm::operator()(Vec3d p) const {
  double d = webs(eminences(flesh(p), p), p);
  if (d > 20) return d;
  const double front = smooth_step(-14, 5, p.z), line = smooth_step(-5, 7, p.z), back = smooth_step(2, 8, -p.z);
  d += 4.0 * bump(std::hypot((p.x + 2 - 0.10 * (p.y - 50)) / 28, (p.y - 45) / 42), 1) * front;  // the hollow
  for (const Line& l : lines_) {
    double u;
    const double t = l.curve.distance(p.x, p.y, &u);
    const double shape = bump(t, l.width) + l.shoulder * bump(t, l.width * 5);
    d += l.depth * shape * smooth_step(0, l.fade_in, u) * (l.fade_out < 1 ? smooth_step(1, l.fade_out, u) : 1) * (l.on_palm ? line : back);
  }
  return d;
}

}  // namespace stokes
