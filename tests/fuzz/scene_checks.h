// What a scene's description promises, checked for one that was read from any bytes. Knows descriptions, not the text.
#pragma once
#include "scene/description.h"

namespace stokes::fuzz {

/// Ends the process when something in the description is not finite, out of order, out of range or missing.
void check_description(const SceneDescription& scene);

}  // namespace stokes::fuzz
