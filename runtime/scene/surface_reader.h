// Reads surfaces and flattens groups. Knows nothing of how surfaces are intersected.
#pragma once
#include <functional>

#include "scene/read_context.h"

namespace stokes {

/// Appends the leaves of the top-level `surfaces` to the scene. `before_meshes`: see ReadOptions.
void read_surfaces(ReadContext& context, const JsonNode& list, const std::function<void(const SceneDescription&)>& before_meshes = {});

}  // namespace stokes
