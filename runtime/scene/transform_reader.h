// Reads transforms. Knows nothing of what is transformed.
#pragma once
#include "scene/json_node.h"

namespace stokes {

/// One command, or an array of commands applied in listed order (first entry first). Fails when the result is singular.
Affine read_transform(const JsonNode& node);

}  // namespace stokes
