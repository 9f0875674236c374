// Where a mesh passes through itself.
#pragma once
#include "mesh/mesh.h"

namespace stokes {

/// The faces, in order, that an edge of a face with no vertex in common passes through, and the faces of these edges. Coplanar overlap is not seen.
std::vector<std::uint32_t> self_intersections(const MeshData& mesh);

}  // namespace stokes
