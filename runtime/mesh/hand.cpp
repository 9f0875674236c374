// The flesh of the procedural hand: how the digits and the palm are joined. Creases, tendons and hollows are
// small displacements whose slope stays below about a half, so that the field stays close to a distance.
#include "mesh/hand.h"

#include <memory>

#include "mesh/hand_digit.h"
#include "mesh/hand_palm.h"
#include "mesh/hand_skeleton.h"

namespace stokes {

using namespace sdf;

namespace {

constexpr double kCutY = -22;

}  // namespace

Field hand_field(const HandPose& pose) {
  const HandSkeleton skeleton = hand_skeleton(pose);
  struct Hand {
    HandPalm palm;
    HandDigit thumb;
    std::vector<HandDigit> fingers;
  };
  const auto hand = std::make_shared<Hand>(Hand{{skeleton, pose.arch}, {skeleton.thumb, kThumb}, {}});
  for (int f = 0; f < 4; f++) hand->fingers.emplace_back(skeleton.fingers[f], kFingers[f]);
  return [hand](Vec3d p) {
    const double base = hand->palm(p);
    double d = smooth_min(base, hand->thumb(p), 9);
    // Each finger blends with the palm, never with its neighbour.
    for (const HandDigit& finger : hand->fingers) {
      const double reach = length(p - finger.bones().bones[1].origin) - 75;  // beyond this the finger cannot matter
      if (reach > d + 6) continue;
      // What the finger adds, and no more: where it adds nothing, nothing is blended.
      const double joined = smooth_min(base, finger(p), 5), share = smooth_step(0, 1.5, base - joined);
      d = share > 1e-3 ? smooth_min(d, joined, 0.8 * share) : std::min(d, joined);
    }
    return smooth_max(d, kCutY - p.y, 3);
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
