// See equiangular.h.
#include "reference/equiangular.h"

#include <algorithm>
#include <cmath>

namespace stokes::reference {

Equiangular::Equiangular(const Ray& ray, Vec3d point, double size, double t_max) {
  foot_ = dot(point - ray.o, ray.d);
  height_ = std::max(size, length(ray.o + ray.d * foot_ - point));
  first_ = std::atan(-foot_ / height_);
  last_ = std::atan((t_max - foot_) / height_);
}

double Equiangular::sample(double u) const { return std::max(0.0, foot_ + height_ * std::tan(first_ + u * (last_ - first_))); }

double Equiangular::pdf(double t) const {
  const double distance_squared = height_ * height_ + (t - foot_) * (t - foot_);
  return height_ / (distance_squared * (last_ - first_));
}

}  // namespace stokes::reference
