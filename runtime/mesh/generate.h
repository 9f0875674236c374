// Procedural meshes by name, as a scene asks for them.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace stokes {

struct GeneratorOptions {
  double resolution = 1.5;  ///< mm: spacing of the grid that the surface is cut from; 0.3 to 10
  std::string pose;         ///< hand: "open" (default), "relaxed", "cupping", "pointing"
  /// Head: "pitch" (degrees), "cut" (mm, the height of the base), "asymmetry" (mm). Hand: joint angles in degrees as "index.mcp", "thumb.radial", and "arch" (mm).
  std::vector<std::pair<std::string, double>> parameters;
};

/// What a mesh will be, known without making it.
struct GeneratorPlan {
  Vec3d lo, hi;                    ///< mm: a box that holds it
  std::vector<std::string> masks;  ///< names
  std::uint64_t bytes = 0;         ///< about what making it takes
};

/// Throws as generate_mesh does, in no time.
GeneratorPlan plan_mesh(const std::string& name, const GeneratorOptions& options);

/// The mesh called `name` ("head" or "hand"), in millimetres: closed, with normals from its field, and masks. Throws std::invalid_argument
/// for a name, pose, parameter or value that it does not know.
MeshData generate_mesh(const std::string& name, const GeneratorOptions& options);

}  // namespace stokes
