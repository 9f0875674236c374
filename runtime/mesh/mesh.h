// A triangle mesh in local space, as read from a file or made by a generator. Knows nothing of scenes or materials.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "math/vec.h"

namespace stokes {

/// Triangles in local space. `normals` and `uvs` are empty or parallel to `positions`. Masks: one value in [0, 1] per vertex.
struct MeshData {
  std::vector<Vec3d> positions, normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::pair<std::string, std::vector<float>>> masks;
};

/// Counts that say whether a mesh is closed: every edge is shared by exactly two triangles, in opposite directions.
struct MeshTopology {
  std::size_t boundary_edges = 0;      ///< edges of one triangle
  std::size_t nonmanifold_edges = 0;   ///< edges of more than two triangles, or of two in the same direction
  bool watertight() const { return boundary_edges == 0 && nonmanifold_edges == 0; }
};
MeshTopology mesh_topology(const MeshData& mesh);

}  // namespace stokes
