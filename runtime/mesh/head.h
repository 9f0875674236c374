// A procedural adult head of African descent as a signed distance field, in millimetres.
//
// Frame: +x to the subject's left, +y up, +z to the front; the origin lies in the midsagittal plane (x = 0), on the eye line (y = 0) and
// in the plane of the traguses (z = 0). Eyes closed, full lips; not a likeness of any person.
#pragma once
#include "mesh/field.h"
#include "mesh/isosurface.h"

namespace stokes {

struct HeadShape {
  double pitch = 0;          ///< degrees, positive looks up, about the atlas joint
  double cut_y = -226;       ///< the flat bottom of the bust; above -160 only the neck is left
  double asymmetry = 0.5;    ///< gentle left-right wander of the midline, mm
};

/// The signed distance to the head's skin (first order near the surface).
Field head_field(const HeadShape& shape = {});
/// A box that holds the head.
void head_bounds(const HeadShape& shape, Vec3d& lo, Vec3d& hi);
/// Masks over the skin, 0 to 1: "lips", "lashes", "brows".
std::vector<std::pair<std::string, Field>> head_masks(const HeadShape& shape = {});

}  // namespace stokes
