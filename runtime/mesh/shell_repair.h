// Mends an offset mesh that kept its parent's connectivity: faces that turned over, and places off the wanted distance.
#pragma once
#include "mesh/mesh.h"
#include "mesh/mesh_distance.h"

namespace stokes {

/// What is wrong with a mesh that should lie at a signed distance d from another.
struct ShellFaults {
  std::size_t flipped = 0;  ///< faces that look against the distance's gradient
  std::size_t crossed = 0;  ///< faces that pass through one another
  std::size_t off_vertices = 0, off_faces = 0;  ///< vertices, and faces' middles, more than 5 % off the distance
};
/// How bad faults are: whatever is more than a face's middle comes first.
bool worse(const ShellFaults& a, const ShellFaults& b);
ShellFaults shell_faults(const MeshData& shell, const MeshDistance& distance, double d);

/// Moves the vertices around each fault, and no others, to where the fewest faults are left: along the surface towards the middle of
/// their neighbours, and back onto the distance. Ends when nothing is wrong or nothing helps; what is left is returned.
/// A mesh that does not pass through itself still does not after: what comes to cross is put back.
ShellFaults repair_shell(MeshData& shell, const MeshDistance& distance, double d, bool guarded = false);

}  // namespace stokes
