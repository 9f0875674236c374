// The head's bones and masses without its features, in the head's frame (see head.h).
#pragma once
#include "mesh/field.h"
#include "mesh/spline_tube.h"

namespace stokes {

/// Skull, face, cheekbones, jaw and brow. Built once: rotations and splines are resampled here and only evaluated afterwards.
struct Skull {
  double operator()(Vec3d p, Vec3d m) const;

  sdf::Rotation temporalis = sdf::rotation(0, 16, 4), malar = sdf::rotation(0, 28, -14), masseter = sdf::rotation(0, 10, 10);
  sdf::Rotation buccal = sdf::rotation(0, 25, 10), orbit = sdf::rotation(0, 16, -6);
  sdf::SplineTube arch{{48, -22, 60, 9}, {56.5, -20, 36, 9.5}, {59, -18, 6, 10}};
  sdf::SplineTube mandible{{6, -101, 81, 10}, {21, -97, 70, 9.5}, {34, -87, 46, 10}, {43, -72, 18, 11}, {51, -40, 2, 13}};
  sdf::SplineTube brow_ridge{{6, 15, 87, 6.5}, {20, 17, 86.8, 7}, {36, 17.5, 81.5, 7}, {49, 11.5, 68.5, 7}, {54, 0, 58, 6}};

 private:
  double cranium(Vec3d p) const;
  double face(Vec3d p, Vec3d m) const;
  double jaw(Vec3d p) const;
};

}  // namespace stokes
