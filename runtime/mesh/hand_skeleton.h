// The bones of the procedural hand: forward kinematics from a pose to one frame per bone.
#pragma once
#include <array>

#include "mesh/hand.h"

namespace stokes {

/// A bone: y runs along it, z to the palm's side.
struct Bone {
  Vec3d origin;
  sdf::Rotation frame;
  double length;
  Vec3d local(Vec3d p) const { return frame.to_local(p - origin); }
  Vec3d world(Vec3d p) const { return origin + frame.to_world(p); }
};

/// Measures of one finger in mm: base and head of the metacarpal, lengths of the phalanges, half widths at base, mid-proximal, PIP,
/// mid-middle, DIP and tip, and the nail's width and length.
struct FingerShape {
  Vec3d cmc, mcp;
  std::array<double, 3> lengths;
  std::array<double, 6> radii;
  double nail_width, nail_length;
};

struct Digit {
  std::array<Bone, 3> bones;
  std::array<double, 3> flexion;  ///< radians at the joint where each bone begins
};

struct HandSkeleton {
  std::array<Digit, 4> fingers;  ///< index, middle, ring, little
  Digit thumb;
};

extern const std::array<FingerShape, 4> kFingers;
struct ThumbShape {
  Vec3d cmc;
  std::array<double, 3> lengths;
  std::array<double, 5> radii;
  double nail_width, nail_length;
};
extern const ThumbShape kThumb;

HandSkeleton hand_skeleton(const HandPose& pose);

}  // namespace stokes
