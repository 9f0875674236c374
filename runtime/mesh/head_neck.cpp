// Neck and shoulders: a leaning column, larynx, sternocleidomastoid, trapezius, collarbones and the chest's upper edge.
#include "mesh/head_neck.h"

namespace stokes {

using namespace sdf;

Neck::Neck(Vec3d a)
    : sternal_head({{a.x, a.y, a.z, 9}, {46, -85, 6, 9}, {29, -140, 25, 7.5}, {10, -193, 31, 5.5}}),
      clavicular_head({{46, -95, 6, 6}, {38, -145, 14, 7}, {34, -190, 19, 6}}) {}

double Neck::operator()(Vec3d n, Vec3d nm) const {
  double d = smooth_min(capsule(n, {0, -30, -8}, {0, -215, -37}, 43, 51), ellipsoid(n, {0, -140, 7}, {36, 70, 31}), 16);
  d = smooth_min(d, ellipsoid(n, {0, -142, 30}, {8, 16, 13}), 10);                    // larynx
  d = trapezius.join(d, nm, 22);
  d = smooth_min(d, ellipsoid(n, {0, -250, -22}, {125, 70, 62}), 20);                  // chest and back
  d = smooth_min(d, capsule(nm, {30, -208, -24}, {108, -208, -34}, 27, 25), 22);       // shoulder
  d = smooth_min(d, smooth_min(sternal_head(nm), clavicular_head(nm), 6), 9);
  d = clavicle.join(d, nm, 13);
  d = carve(d, ellipsoid(n, {0, -192, 46}, {9, 12, 12}), 9);                           // jugular notch
  return smooth_max(d, ellipsoid({n.x, std::min(n.y, -150.0), n.z}, {0, -150, -18}, {100, 92, 76}), 6);  // the bust's outline
}

}  // namespace stokes
