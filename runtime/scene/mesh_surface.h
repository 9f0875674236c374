// Surfaces that are meshes: what is known of them before their triangles are, and the loading. Knows nothing of other surfaces.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/read_context.h"

namespace stokes {

/// A surface as its JSON says it. Meshes are loaded when everything else has been checked.
struct SurfaceDraft {
  SurfaceDescription surface;              ///< of meshes: with a triangle about as large in the mesh's place
  std::function<void(ReadContext&)> load;  ///< appends the mesh's surfaces to the scene; empty: the surface is complete
  bool slow = false;                       ///< loading may take seconds
};

/// The keys of a mesh beside those of all surfaces.
std::vector<std::string> mesh_keys();

/// Checks all of a mesh but its triangles. `o` refers to JSON that must outlive the draft.
SurfaceDraft draft_mesh(ReadContext& context, const JsonObject& o, SurfaceDescription surface);

}  // namespace stokes
