// A camera that a hand turns about a point. See orbit.h.
#include "view/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stokes {
namespace {

constexpr double kPole = 0.5 * std::numbers::pi - 0.01;

/// `v` turned about the unit vector `axis` (Rodrigues' formula).
Vec3d turned(Vec3d v, Vec3d axis, double angle) {
  return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
}

/// The axis of the world that the camera's own upwards is nearest to: what a scene's author most likely calls up.
Vec3d upright(Vec3d y) {
  const double size[3] = {std::abs(y.x), std::abs(y.y), std::abs(y.z)};
  const int axis = static_cast<int>(std::max_element(size, size + 3) - size);
  const double sign = y[axis] < 0 ? -1 : 1;
  return {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
}

void set_column(Affine& a, int i, Vec3d v) {
  const auto column = static_cast<std::size_t>(i);
  a.m[column] = v.x;
  a.m[4 + column] = v.y;
  a.m[8 + column] = v.z;
}

}  // namespace

Orbit::Orbit(const CameraDescription& camera, double reach) : first_(camera), reach_(reach) {
  const Vec3d backwards = normalize(camera.transform.column(2));
  center_ = camera.transform.translation() - backwards * reach;
  up_ = upright(normalize(camera.transform.column(1)));
  const double elevation = std::asin(std::clamp(dot(backwards, up_), -1.0, 1.0));
  lowest_ = std::min(0.0, -kPole - elevation);
  highest_ = std::max(0.0, kPole - elevation);
}

void Orbit::turn(double around, double up) {
  around_ = std::remainder(around_ + around, 2 * std::numbers::pi);
  tilt_ = std::clamp(tilt_ + up, lowest_, highest_);
}

void Orbit::shift(double right, double up) {
  const CameraDescription now = camera();
  const double height = now.orthographic ? now.height * length(now.transform.column(1))
                                         : 2 * reach_ * scale_ * std::tan(now.vfov * std::numbers::pi / 360);
  shift_ += (normalize(now.transform.column(0)) * right + normalize(now.transform.column(1)) * up) * height;
}

void Orbit::zoom(double factor) { scale_ = std::clamp(scale_ * factor, 1e-3, 1e3); }

void Orbit::reset() {
  around_ = tilt_ = 0;
  scale_ = 1;
  shift_ = {};
}

bool Orbit::moved() const { return around_ != 0 || tilt_ != 0 || scale_ != 1 || length_squared(shift_) > 0; }

CameraDescription Orbit::camera() const {
  CameraDescription camera = first_;
  if (!moved()) return camera;
  // First up or down about the camera's own x axis, then around.
  const Vec3d sideways = normalize(first_.transform.column(0));
  const auto rotate = [&](Vec3d v) { return turned(turned(v, sideways, -tilt_), up_, around_); };
  for (int i = 0; i < 3; i++) set_column(camera.transform, i, rotate(first_.transform.column(i)));
  // An orthographic camera sees more or less instead of coming nearer; a lens stays focused on what it was focused on.
  const double distance = first_.orthographic ? 1 : scale_;
  if (first_.orthographic) camera.height *= scale_;
  camera.fdist *= distance;
  const Vec3d offset = first_.transform.translation() - center_;
  set_column(camera.transform, 3, center_ + shift_ + rotate(offset) * distance);
  return camera;
}

}  // namespace stokes
