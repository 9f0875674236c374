// Mends shells: faces that turned over or cross, and places off the wanted distance. Knows nothing of how the shell came about.
#pragma once
#include "mesh/mesh.h"
#include "mesh/shell_measure.h"

namespace stokes {

/// Mends a closed shell that should lie at signed distance d, by local edits around its faults and nowhere else: vertices move onto the
/// level and onto its ridges, edges turn, divide and collapse, patches are taken out and closed by others: each edit only where it leaves
/// less wrong than it found, crossings included. Long faces that nothing helps are divided. Ends when nothing is wrong, nothing helps,
/// or the work, which is limited by the number of faces, is done; does not begin where half the faces are wrong. Returns the faults that are left.
/// Where nothing is wrong the shell is not touched; else only its positions and triangles are kept, renumbered.
ShellFaults repair_shell(MeshData& shell, const MeshDistance& distance, double d);

}  // namespace stokes
