// Reads participating media. Knows nothing of the surfaces that bound them.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// An inline medium, or the name of one. `null`, "vacuum" and "air" (unless so named ones are defined) are a null pointer: vacuum.
MediumPtr read_medium(ReadContext& context, const JsonNode& node);
/// The entries of the top-level `media`.
void read_named_media(ReadContext& context, const JsonNode& list);
/// "m", "cm" or "mm".
LengthUnit read_length_unit(const JsonNode& node);

}  // namespace stokes
