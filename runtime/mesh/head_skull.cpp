// Bones and masses of the head: which ellipsoid or tube stands for what, and how softly it joins the rest.
#include "mesh/head_skull.h"

namespace stokes {

using namespace sdf;

double Skull::cranium(Vec3d p) const {
  const Vec3d m{std::sqrt(p.x * p.x + 81), p.y, p.z};  // a wide smooth |x|: no seam on the forehead
  double d = ellipsoid(p, {0, 32, -4}, {73.5, 79, 93});                               // brain case
  d = smooth_min(d, ellipsoid(p, {0, 30, 32}, {60, 54, 60}), 26);                     // frontal bone
  d = smooth_min(d, ellipsoid(p, {0, 14, -42}, {60, 56, 50}), 28);                    // occiput
  d = smooth_min(d, ellipsoid(m, {22, 42, 60}, {26, 24, 26}), 26);                    // frontal eminences
  return smooth_min(d, ellipsoid(m, {52, 12, 38}, {14, 32, 30}, temporalis), 24);
}

double Skull::face(Vec3d p, Vec3d m) const {
  double d = ellipsoid(p, {0, -22, 32}, {58, 74, 55});
  d = smooth_min(d, ellipsoid(p, {0, -64, 62}, {33, 33, 38.5}), 20);                    // maxilla
  return smooth_min(d, ellipsoid(m, {31, -36, 62}, {25, 28, 23}), 18);                // cheek fat
}

double Skull::jaw(Vec3d p) const {
  const Vec3d m{std::sqrt(p.x * p.x + 36), p.y, p.z};
  double d = mandible(m);
  d = smooth_min(d, ellipsoid(m, {43, -45, 27}, {18, 34, 30}, masseter), 18);
  d = smooth_min(d, ellipsoid(m, {34, -60, 52}, {15, 26, 21}, buccal), 16);
  d = smooth_min(d, ellipsoid(p, {0, -101, 82}, {17.5, 12.5, 15}), 12);               // chin
  return smooth_min(d, ellipsoid(p, {0, -90, 42}, {32, 16, 46}), 16);                 // floor of the mouth
}

double Skull::operator()(Vec3d p, Vec3d m) const {
  double d = cranium(p);
  d = smooth_min(d, face(p, m), 24);
  d = carve(d, ellipsoid(m, {80, 10, 66}, {15, 34, 28}), 22);                         // temple
  d = smooth_min(d, jaw(p), 16);
  d = smooth_min(d, smooth_min(ellipsoid(m, {47, -21, 64.5}, {15, 10, 18}, malar), arch(m), 20), 24);  // cheekbone
  d = smooth_min(d, smooth_min(brow_ridge({std::sqrt(p.x * p.x + 36), p.y, p.z}), ellipsoid(p, {0, 15, 85}, {16, 10, 10}), 10), 12);
  return carve(d, ellipsoid(m, {34, -3, 98.5}, {20.5, 13, 19}, orbit), 9);
}

}  // namespace stokes
