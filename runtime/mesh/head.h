// A procedural adult head of African descent as a signed distance field, in millimetres.
//
// Frame: +x to the subject's left, +y up, +z to the front; the origin lies in the midsagittal plane (x = 0), on the eye line (y = 0) and
// in the plane of the traguses (z = 0). Eyes closed, full lips; not a likeness of any person.
//
// Proportions follow the canons and the ranges of L. G. Farkas, Anthropometry of the Head and Face (1994), within some millimetres:
//   vertex to chin 226, eyes at half of it; subnasale at y = -51, the mouth's line at -72, the chin's point at -100
//   skull 201 long and 147 wide; between the eyes as much as one eye, 33; nose 45 wide; mouth 51 wide
//   ear 65 long, from the brow to the base of the nose
// Neck and shoulders are shortened to a bust: the collarbones' notch lies at y = -193, the flat base at -226.
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
