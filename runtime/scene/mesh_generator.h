// The hook for procedural meshes: the scene reader asks, whoever registered answers.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/description.h"

namespace stokes {

/// What a scene asks of a procedural mesh, beside its name.
struct MeshGeneratorOptions {
  int triangles = 0;   ///< about as many as this; 0: the generator's choice
  double offset = 0;   ///< mm: the surface at this signed distance from the figure's own (negative: inside), by its distance field
  std::vector<std::pair<std::string, double>> parameters;  ///< the figure's own, such as pitch
};

/// Makes the mesh called `name` ("head", "hand"), in millimetres. Throws std::invalid_argument for a name, a parameter or a value
/// that it does not know; the scene reader turns that into a SceneError.
using MeshGenerator = MeshData (*)(const std::string& name, const MeshGeneratorOptions& options);

/// The registered generator, or null.
MeshGenerator& mesh_generator();

}  // namespace stokes
