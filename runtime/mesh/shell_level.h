// The parallel surface cut anew from the exact distance on a grid.
#pragma once
#include "mesh/mesh.h"
#include "mesh/mesh_distance.h"

namespace stokes {

/// The surface at signed distance d from a mesh that fills the box lo..hi, by marching cubes of edge `step`; it shares no connectivity with
/// the mesh. Every vertex is where a grid edge crosses the exact level, or has slid along the level without turning a face over.
MeshData distance_level(const MeshDistance& distance, Vec3d lo, Vec3d hi, double d, double step);

}  // namespace stokes
