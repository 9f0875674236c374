// Parallel surfaces: the same mesh a given distance further out or in.
#pragma once
#include "mesh/mesh.h"

namespace stokes {

/// Moves every vertex by d along its normal (the mesh's own, or the area-weighted mean of its faces'), as the report does; d < 0 shrinks.
/// `flipped` counts the faces whose normal then points the other way.
MeshData offset_along_normals(const MeshData& mesh, double d, std::size_t* flipped);

/// The surface at signed distance d from the mesh (negative: inside). Thin shells keep the mesh's connectivity, with a few more vertices in
/// sharp creases; where that folds, crosses itself or leaves the distance, the level is cut anew from the exact distance on a grid of `step`
/// (0: chosen from the mesh and d). Every vertex is within 5 % of the distance; faces that span a ridge of the level cut its corner. Faces
/// that look against the distance's gradient at their middle, or cross, are left only in slivers thinner than a face is bent: one to ten in ten
/// thousand where d is large for the mesh. Masks and uvs are those of the nearest points of the mesh. The mesh must be closed. Throws std::runtime_error when
/// it is not, or when nothing is left at that distance.
MeshData offset_by_distance_field(const MeshData& mesh, double d, double step = 0);

}  // namespace stokes
