// Measures, poses and forward kinematics of the procedural hand.
#include "mesh/hand_skeleton.h"

#include <map>
#include <numbers>

namespace stokes {

using sdf::rotation;

const std::array<FingerShape, 4> kFingers = {{
    {{11, 26, -2.0}, {25.5, 86, -0.5}, {44, 26.0, 23.0}, {10.0, 8.6, 8.5, 7.7, 7.3, 6.4}, 10.6, 11.0},
    {{2, 25, -4.0}, {6.0, 89, -3.0}, {48.5, 29.5, 24.0}, {10.1, 8.8, 8.7, 7.9, 7.5, 6.6}, 11.0, 11.5},
    {{-7, 24, -3.5}, {-13.0, 83, -2.0}, {45, 28.0, 23.5}, {9.6, 8.3, 8.2, 7.4, 7.1, 6.2}, 10.2, 10.8},
    {{-14, 22, -1.0}, {-28.5, 74, 1.0}, {36, 21.0, 21.0}, {8.8, 7.3, 7.1, 6.4, 6.2, 5.4}, 8.4, 8.8},
}};
const ThumbShape kThumb = {{19, 21, 5.0}, {45, 33.0, 29.0}, {12.6, 10.6, 9.9, 9.4, 7.4}, 13.2, 13.5};

const HandPose* find_hand_pose(const std::string& name) {
  static const std::map<std::string, HandPose> poses = {
      {"open", {{7, 13, 7, 6, -4}, {10, 16, 8, 0.5, 0}, {13, 19, 9, -6, 4}, {14, 20, 10, -15, 9}, {38, 22, 46, 10, 12}, 2}},
      {"relaxed", {{20, 26, 13, 4, -4}, {26, 32, 16, 0, 0}, {31, 36, 18, -4, 4}, {35, 38, 19, -9, 8}, {26, 30, 52, 14, 20}, 4}},
      {"cupping", {{17, 23, 12, 6, -5}, {22, 26, 14, 0.5, 0}, {26, 29, 15, -5, 5}, {29, 31, 15, -13, 11}, {38, 40, 58, 10, 12}, 6}},
      {"pointing", {{6, 8, 4, 3, -2}, {72, 92, 50, 0, 0}, {78, 94, 52, -2, 3}, {80, 92, 50, -5, 6}, {22, 44, 66, 28, 38}, 5}},
  };
  const auto it = poses.find(name);
  return it == poses.end() ? nullptr : &it->second;
}

HandSkeleton hand_skeleton(const HandPose& pose) {
  constexpr double to_radians = std::numbers::pi / 180;
  constexpr double rise[4] = {0, 0, 0.4, 1};  // how much of the arch each knuckle takes part in
  const HandPose::Finger* angles[4] = {&pose.index, &pose.middle, &pose.ring, &pose.little};
  auto chain = [&](Vec3d origin, sdf::Rotation frame, const std::array<double, 3>& lengths, double second, double third) {
    Digit d;
    const double bends[3] = {0, second, third};
    for (int i = 0; i < 3; i++) {
      frame = frame * rotation(bends[i], 0, 0);
      d.bones[i] = {origin, frame, lengths[i]};
      d.flexion[i] = bends[i] * to_radians;
      origin += frame.y * lengths[i];
    }
    return d;
  };
  HandSkeleton s;
  for (int f = 0; f < 4; f++) {
    const HandPose::Finger& a = *angles[f];
    const sdf::Rotation frame = rotation(0, 0, -a.spread) * rotation(0, a.roll, 0) * rotation(a.mcp, 0, 0);
    s.fingers[f] = chain(kFingers[f].mcp + Vec3d{0, 0, rise[f] * pose.arch}, frame, kFingers[f].lengths, a.pip, a.dip);
  }
  const HandPose::Thumb& t = pose.thumb;
  const sdf::Rotation frame = rotation(0, 0, -t.radial) * rotation(t.palmar, 0, 0) * rotation(0, -t.pronation, 0);
  s.thumb = chain(kThumb.cmc, frame, kThumb.lengths, t.mcp, t.ip);
  return s;
}

}  // namespace stokes
