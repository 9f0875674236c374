// The flesh of the procedural hand: digits in their bones' frames, the palm, and how they are joined. Creases, tendons and hollows are
// small displacements whose slope stays below about a half, so that the field stays close to a distance.
#include "mesh/hand.h"

#include <memory>
#include <numbers>

#include "mesh/hand_palm.h"
#include "mesh/hand_skeleton.h"

namespace stokes {

using namespace sdf;

namespace {

constexpr double kCutY = -22;

Rotation half_bend(const Bone& previous, double flexion) { return previous.frame * rotation(0.5 * flexion * 180 / std::numbers::pi, 0, 0); }

struct Crease {
  double y, depth, width;
  double side;  // +1 palm, -1 back
  double bow;
};

double cut_creases(double d, Vec3d q, double half_width, std::initializer_list<Crease> creases) {
  for (const Crease& c : creases)
    d += c.depth * bump(q.y - c.y - c.bow * q.x * q.x, c.width) * smooth_step(half_width * 0.15, half_width * 0.9, q.z * c.side);
  return d;
}

// The nail's plate in the end bone's frame: a bent shell let into the back of the tip; flesh is the height of the flesh there.
double nail(double d, Vec3d q, double length, double flesh, double width, double nail_length) {
  const double radius = 0.62 * width, middle = length - 0.5 * nail_length - 1.6;
  const double dy = q.y - middle, drop = std::clamp(dy, 0.0, 8.0);
  const double zz = q.z + flesh - radius - 0.15 - 0.012 * dy - 0.024 * drop * drop;
  const double u = radius * std::atan2(q.x, -zz), w = std::hypot(q.x, zz) - radius;
  constexpr double corner = 3;
  const double ax = std::abs(u) - (0.5 * width - corner), ay = std::abs(dy) - (0.5 * nail_length - corner);
  const double outline = std::hypot(std::max(ax, 0.0), std::max(ay, 0.0)) + std::min(std::max(ax, ay), 0.0) - corner;
  const double far = (1 - smooth_step(-2, 3, -q.z)) * 4;
  d = smooth_max(d, -(smooth_max(outline, -0.3 - w, 0.5) + far), 0.9);                                                        // bed
  d += 0.35 * bump(outline - 0.5, 1.7) * smooth_step(0.5, 3, -q.z) * smooth_step(-0.5 * nail_length, -0.3 * nail_length, -dy);  // folds
  return smooth_min(d, smooth_max(outline - 0.35, std::abs(w + 0.85) - 0.85, 0.8) + far, 0.5);
}

double digit_tip(Vec3d q, double length, double joint, double tip, double nail_width, double nail_length) {
  const double ra = joint * 0.97, rb = tip * 0.95, h = length - tip;
  double d = round_cone(q, ra, rb, 0, h, 0.94, 1.04);
  d = smooth_min(d, ellipsoid(q, {0, length * 0.58, tip * 0.30}, {tip * 0.98, length * 0.40, tip * 0.90}), 3);
  const double flesh = (ra + (rb - ra) * std::min(1.0, (length - 0.5 * nail_length - 1.6) / h)) / 1.04;
  return nail(d, q, length, flesh, nail_width, nail_length);
}

double finger(Vec3d p, const FingerShape& f, const Digit& s) {
  const auto& [rb, r1, rp, r2, rd, rt] = f.radii;
  const auto& [L0, L1, L2] = f.lengths;
  const Vec3d q0 = s.bones[0].local(p), q1 = s.bones[1].local(p), q2 = s.bones[2].local(p);
  double d = round_cone(q0, rb, r1, 0, L0 * 0.55, 0.97);
  d = smooth_min(d, round_cone(q0, r1, rp, L0 * 0.5, L0), 1.5);
  d = smooth_min(d, ellipsoid(q0, {0, L0 * 0.60, r1 * 0.32}, {r1 * 0.78, L0 * 0.30, r1 * 0.80}), 3);
  const Vec3d h1 = half_bend(s.bones[0], s.flexion[1]).to_local(p - s.bones[1].origin);
  d = smooth_min(d, ellipsoid(h1, {0, 0, -0.6}, {rp * 0.95, rp * 1.25, rp * 0.97}), 2.5);
  double middle = round_cone(q1, rp * 0.97, r2, 0, L1 * 0.5, 0.99);
  middle = smooth_min(middle, round_cone(q1, r2, rd, L1 * 0.5, L1), 1.2);
  middle = smooth_min(middle, ellipsoid(q1, {0, L1 * 0.52, r2 * 0.30}, {r2 * 0.78, L1 * 0.40, r2 * 0.80}), 2.5);
  d = smooth_min(d, middle, 2);
  const Vec3d h2 = half_bend(s.bones[1], s.flexion[2]).to_local(p - s.bones[2].origin);
  d = smooth_min(d, ellipsoid(h2, {0, 0, -0.3}, {rd * 0.91, rd * 1.3, rd * 0.93}), 2);
  d = smooth_min(d, digit_tip(q2, L2, rd, rt, f.nail_width, f.nail_length), 2);
  d = cut_creases(d, h1, rp, {{1.3, 0.55, 1.5, 1, 0.004}, {-1.6, 0.45, 1.4, 1, -0.004}});
  d = cut_creases(d, h2, rd, {{0, 0.55, 1.5, 1, 0.004}});
  d = cut_creases(d, h1, rp, {{-3.7, 0.10, 1.4, -1, -0.016}, {-1.5, 0.24, 1.4, -1, -0.016}, {0.9, 0.26, 1.4, -1, 0.016}, {3.0, 0.14, 1.4, -1, 0.016}});
  d = cut_creases(d, h2, rd, {{-1.2, 0.16, 1.1, -1, -0.01}, {1.0, 0.2, 1.1, -1, 0.01}});
  return cut_creases(d, q0, r1, {{L0 * 0.37, 0.7, 1.8, 1, 0.004}});
}

double thumb(Vec3d p, const Digit& s) {
  const auto& [rc, rm, r1, ri, rt] = kThumb.radii;
  const auto& [L0, L1, L2] = kThumb.lengths;
  const Vec3d q0 = s.bones[0].local(p), q1 = s.bones[1].local(p), q2 = s.bones[2].local(p);
  double d = round_cone(q0, rc, rm, 0, L0);
  const Vec3d h1 = half_bend(s.bones[0], s.flexion[1]).to_local(p - s.bones[1].origin);
  d = smooth_min(d, ellipsoid(h1, {0, 0, -0.4}, {rm * 0.95, rm * 1.3, rm * 0.94}), 4);
  d = smooth_min(d, round_cone(q1, rm, r1, 0, L1 * 0.5), 3);
  d = smooth_min(d, round_cone(q1, r1, ri, L1 * 0.5, L1), 1.5);
  d = smooth_min(d, ellipsoid(q1, {0, L1 * 0.5, r1 * 0.36}, {r1 * 0.88, L1 * 0.36, r1 * 0.84}), 3);
  const Vec3d h2 = half_bend(s.bones[1], s.flexion[2]).to_local(p - s.bones[2].origin);
  d = smooth_min(d, ellipsoid(h2, {0, 0, -0.3}, {ri * 0.96, ri * 1.25, ri * 0.95}), 2.5);
  d = smooth_min(d, digit_tip(q2, L2, ri * 0.96, rt, kThumb.nail_width, kThumb.nail_length), 3);
  d = cut_creases(d, h2, ri, {{0.8, 0.65, 1.8, 1, 0.004}, {-2.4, 0.5, 1.5, 1, -0.004}});
  d = cut_creases(d, h1, rm, {{1.0, 0.45, 2.0, 1, 0}});
  return cut_creases(d, h2, ri, {{-3.9, 0.07, 1.6, -1, -0.018}, {-1.4, 0.2, 1.6, -1, -0.018}, {1.0, 0.22, 1.6, -1, 0.018}, {3.1, 0.1, 1.6, -1, 0.018}});
}

}  // namespace

Field hand_field(const HandPose& pose) {
  const auto skeleton = std::make_shared<const HandSkeleton>(hand_skeleton(pose));
  const auto palm = std::make_shared<const HandPalm>(*skeleton, pose.arch);
  return [skeleton, palm](Vec3d p) {
    const double base = (*palm)(p);
    double d = smooth_min(base, thumb(p, skeleton->thumb), 9);
    // Each finger blends with the palm, never with its neighbour.
    for (int f = 0; f < 4; f++) {
      const Digit& digit = skeleton->fingers[f];
      const double reach = length(p - digit.bones[1].origin) - 75;  // beyond this the finger cannot matter
      if (reach > d + 6) continue;
      d = smooth_min(d, smooth_min(base, finger(p, kFingers[f], digit), 5), 0.8);
    }
    return std::max(d, kCutY - p.y);
  };
}

void hand_bounds(const HandPose& pose, Vec3d& lo, Vec3d& hi) {
  const HandSkeleton s = hand_skeleton(pose);
  lo = {-48, kCutY - 1, -24};
  hi = {46, 95, 32};
  auto add = [&](const Digit& d) {
    for (const Bone& b : d.bones)
      for (const Vec3d& end : {b.origin, b.world({0, b.length, 0})}) lo = min(lo, end - Vec3d{13, 13, 13}), hi = max(hi, end + Vec3d{13, 13, 13});
  };
  for (const Digit& d : s.fingers) add(d);
  add(s.thumb);
  const Vec3d margin{4, 4, 4};
  lo = lo - margin;
  hi = hi + margin;
  lo.y = std::max(lo.y, kCutY - 4);
}

}  // namespace stokes
