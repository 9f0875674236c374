// Surfaces that are meshes: what is known of them before their triangles are, and the loading. Knows nothing of other surfaces.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/read_context.h"

namespace stokes {

/// How long loading a surface takes: nothing or milliseconds; a large file's reading; seconds of generating and offsetting.
enum class LoadingTime { Short, Reading, Long };

/// A surface as its JSON says it. Meshes are loaded when everything else has been checked.
struct SurfaceDraft {
  SurfaceDescription surface;  ///< of meshes: with a triangle about as large in the mesh's place
  std::function<std::vector<SurfaceDescription>(ReadContext&)> load;  ///< the mesh's surfaces, one a material; empty: the surface is complete
  LoadingTime time = LoadingTime::Short;
};

/// The keys of a mesh beside those of all surfaces.
std::vector<std::string> mesh_keys();

/// Checks all of a mesh but its triangles. `o` refers to JSON that must outlive the draft.
SurfaceDraft draft_mesh(ReadContext& context, const JsonObject& o, SurfaceDescription surface);

}  // namespace stokes
