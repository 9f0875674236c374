// Distances along a ray, drawn so that all angles under which they are seen from a point beside it are equally likely. Knows no media.
#pragma once
#include "reference/intersect.h"

namespace stokes::reference {

/// Equiangular sampling (Kulla and Fajardo 2012): the density is proportional to the inverse square of the distance from the point, so light
/// from there that is scattered along the ray varies little over it.
class Equiangular {
 public:
  /// For distances in [0, t_max] (may be infinite). The point is taken to be at least `size` off the ray: the density stays finite.
  Equiangular(const Ray& ray, Vec3d point, double size, double t_max);
  double sample(double u) const;
  double pdf(double t) const;

 private:
  double foot_;          ///< where the ray is nearest to the point
  double height_;        ///< how far it is there
  double first_, last_;  ///< angles under which the ends are seen from the point, from the foot's direction
};

}  // namespace stokes::reference
