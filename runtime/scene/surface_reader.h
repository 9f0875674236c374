// Reads surfaces and flattens groups. Knows nothing of how surfaces are intersected.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// Appends the leaves of the top-level `surfaces` to the scene.
void read_surfaces(ReadContext& context, const JsonNode& list);

}  // namespace stokes
