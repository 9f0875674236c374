// A camera that a hand turns about a point. Knows vectors and the camera's description; no scene, no pixels of a page.
#pragma once
#include "scene/description.h"

namespace stokes {

/// Turns, shifts and distances are kept as numbers apart from the first camera, so that nothing drifts and `reset` is exact.
class Orbit {
 public:
  /// Turns about the point `reach` (scene units) in front of the camera.
  Orbit(const CameraDescription& camera, double reach);

  /// By radians about the scene's upright axis, and up (positive) or down; stops short of the poles.
  void turn(double around, double up);
  /// Shifts camera and centre by fractions of the picture's height, to the right and upwards.
  void shift(double right, double up);
  /// The distance to the centre times `factor`; for an orthographic camera the size of what it sees.
  void zoom(double factor);
  void reset();
  bool moved() const;

  CameraDescription camera() const;
  const CameraDescription& first_camera() const { return first_; }

 private:
  CameraDescription first_;
  Vec3d center_, up_;
  double reach_;
  double around_ = 0, tilt_ = 0, scale_ = 1;
  Vec3d shift_;
  double lowest_, highest_;  // of tilt_
};

}  // namespace stokes
