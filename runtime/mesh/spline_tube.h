// A bent, tapered tube about a smooth curve. Unlike Tube, which is a chain of straight capsules, it has no joints: the surface shows no bands.
#pragma once
#include <array>
#include <vector>

#include "mesh/field.h"

namespace stokes::sdf {

/// The distance to a Catmull-Rom spline through the control points, less a radius that follows the same spline. The nearest point is
/// found among samples and then by Newton's method, so the field is smooth wherever the nearest point is unique.
class SplineTube {
 public:
  SplineTube(std::initializer_list<TubePoint> control) : SplineTube(std::vector<TubePoint>(control)) {}
  explicit SplineTube(const std::vector<TubePoint>& control);
  double operator()(Vec3d p) const;
  /// smooth_min(d, the tube at p, k), bit for bit, without the tube where a ball about it says that it adds nothing.
  double join(double d, Vec3d p, double k) const;

 private:
  static constexpr int kSamples = 4;  // per piece
  struct Piece {
    std::array<Vec3d, 4> position;  // coefficients of 1, t, t^2, t^3
    std::array<double, 4> radius;
  };
  std::vector<Piece> pieces_;
  std::vector<Vec3d> samples_;
  Vec3d ball_center_;  // of a ball that holds the tube
  double ball_radius_ = 0;
};

}  // namespace stokes::sdf
