// The palm of the procedural hand: wrist, metacarpals, eminences, webs, and the lines on it.
#pragma once
#include "mesh/hand_skeleton.h"

namespace stokes {

namespace sdf {
/// A round cone along y from y0 (radius r1) to y1 (radius r2); sx, sz < 1 widen it in x, z.
double round_cone(Vec3d q, double r1, double r2, double y0, double y1, double sx = 1, double sz = 1);
}  // namespace sdf

class HandPalm {
 public:
  HandPalm(const HandSkeleton& skeleton, double arch);
  double operator()(Vec3d p) const;

 private:
  struct Line {  // a crease (depth > 0) or a ridge (depth < 0) drawn along a curve in the xy plane
    sdf::Curve2 curve;
    double depth, width, shoulder;
    double fade_in, fade_out;  // parameters by which it has reached, and from which it loses, its depth
    bool on_palm;
  };
  double flesh(Vec3d p) const;
  double eminences(double d, Vec3d p) const;
  double webs(double d, Vec3d p) const;

  HandSkeleton skeleton_;
  double arch_;
  std::vector<Line> lines_;
};

}  // namespace stokes
