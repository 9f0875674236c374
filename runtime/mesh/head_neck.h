// Neck and shoulder yoke of the procedural head, in the world's frame: they do not nod with the head.
#pragma once
#include "mesh/field.h"
#include "mesh/spline_tube.h"

namespace stokes {

/// The neck and the bust that it stands on, cut to an oval.
struct Neck {
  /// `mastoid`: where the sternocleidomastoid ends behind the ear, which moves with the head.
  explicit Neck(Vec3d mastoid);
  /// The field of neck and shoulders alone at n; nm is n with |x| in place of x.
  double operator()(Vec3d n, Vec3d nm) const;

  sdf::SplineTube sternal_head, clavicular_head;
  sdf::SplineTube trapezius{{13, -50, -42, 13}, {18, -95, -46, 15}, {34, -142, -52, 18}, {66, -176, -50, 19}, {108, -196, -40, 18}};
  sdf::SplineTube clavicle{{12, -197, 25, 6.5}, {34, -195, 22, 5.4}, {62, -189, 7, 5.4}, {90, -183, -18, 6}, {112, -182, -32, 7}};
};

}  // namespace stokes
