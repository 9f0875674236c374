// A procedural, posable right hand as a signed distance field, in millimetres.
//
// Frame: the wrist crease at the origin, fingers towards +y, palm towards +z, thumb towards +x (a right hand seen from its palm). The
// forearm is cut flat at y = -22.
#pragma once
#include <string>

#include "mesh/field.h"
#include "mesh/isosurface.h"

namespace stokes {

/// Joint angles in degrees.
struct HandPose {
  /// One finger: flexion of the knuckle, the middle and the end joint; spread towards the thumb; roll about its axis.
  struct Finger {
    double mcp, pip, dip, spread, roll;
  };
  /// Radial and palmar abduction, pronation, flexion of the middle and the end joint.
  struct Thumb {
    double radial, palmar, pronation, mcp, ip;
  };
  Finger index, middle, ring, little;
  Thumb thumb;
  double arch;  ///< how far the little finger's side of the palm rises, mm
};

/// The poses "open", "relaxed", "cupping" and "pointing"; nullptr for another name.
const HandPose* find_hand_pose(const std::string& name);

/// The signed distance to the hand's skin (first order near the surface).
Field hand_field(const HandPose& pose);
/// A box that holds the hand.
void hand_bounds(const HandPose& pose, Vec3d& lo, Vec3d& hi);

}  // namespace stokes
