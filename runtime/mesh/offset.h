// Parallel surfaces: the same mesh a given distance further out or in.
#pragma once
#include "mesh/mesh.h"

namespace stokes {

/// Moves every vertex by d along its normal (the mesh's own, or the area-weighted mean of its faces'), as the report does; d < 0 shrinks.
/// `flipped` counts the faces whose normal then points the other way.
MeshData offset_along_normals(const MeshData& mesh, double d, std::size_t* flipped);

/// The surface at signed distance d from the mesh (negative: inside), from the exact distance to its triangles on a grid of `step` (0: chosen
/// from the mesh and d). No face flips, folds vanish, and every vertex lies at distance |d| to within `step`-independent rounding.
/// The mesh must be closed. Throws std::runtime_error when it is not, or when nothing is left at that distance.
MeshData offset_by_distance_field(const MeshData& mesh, double d, double step = 0);

}  // namespace stokes
