// Mends an offset mesh that kept its parent's connectivity: faces that turned over, and places off the wanted distance.
#pragma once
#include "mesh/mesh.h"
#include "mesh/mesh_distance.h"

namespace stokes {

/// What is wrong with a mesh that should lie at a signed distance d from another.
struct ShellFaults {
  std::size_t flipped = 0;  ///< faces that look against the distance's gradient
  std::size_t off = 0;      ///< faces whose middle, and vertices that, are more than 5 % off the distance
};
ShellFaults shell_faults(const MeshData& shell, const MeshDistance& distance, double d);

/// Moves the vertices around each fault, and no others, to where the fewest faults are left: along the surface towards the middle of
/// their neighbours, and back onto the distance. Ends when nothing is wrong or nothing helps; what is left is returned.
ShellFaults repair_shell(MeshData& shell, const MeshDistance& distance, double d);

}  // namespace stokes
