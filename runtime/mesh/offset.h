// Parallel surfaces: the same mesh a given distance further out or in.
#pragma once
#include "mesh/mesh.h"

namespace stokes {

/// Moves every vertex by d along its normal (the mesh's own, or the area-weighted mean of its faces'), as the report does; d < 0 shrinks.
/// `flipped` counts the faces whose normal then points the other way.
MeshData offset_along_normals(const MeshData& mesh, double d, std::size_t* flipped);

/// The surface at signed distance d from the mesh (negative: inside). Promised, and checked on every shell that is made:
/// - closed, every edge between two faces, and no face passes through another;
/// - the distance to the mesh is within 5 % of |d| at every vertex and at every face's middle (and that of each edge that bends);
/// - no face is flipped: the normal has a positive component along the distance's gradient at the face's middle, which points from the
///   nearest point of the mesh (d > 0) or to it (d < 0).
/// Where the mesh is thinner than 2 |d| it has no inner shell. First the mesh's own faces are shifted and mended (shell_repair.h), which keeps
/// nearly all of its connectivity; where more than a few faces cannot be, the level is cut anew from the exact distance on a grid of `step`
/// (0: chosen from the mesh and d) and mended; the better is returned. `faulty` counts the places where the promise could not be kept.
/// Masks and uvs are those of the nearest points of the mesh. The mesh must be closed: throws std::runtime_error when it is not, or when
/// nothing is left at that distance.
MeshData offset_by_distance_field(const MeshData& mesh, double d, double step = 0, std::size_t* faulty = nullptr);

}  // namespace stokes
