// Reads textures. Knows nothing of the materials they stand in.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// A spectrum in any form, or a texture.
ColorSource read_color(ReadContext& context, const JsonNode& node, SpectrumRole role, const Range& range);

/// A scalar in [0, 1]: a number, or a texture (fresnel, region, mesh mask, or one of colours whose luminance counts).
struct AmountSource {
  std::optional<double> constant;
  TexturePtr texture;
};
AmountSource read_amount(ReadContext& context, const JsonNode& node);

/// An environment map's or texture's pixels. Fails at `filename`.
std::shared_ptr<const ImagePixels> read_image(ReadContext& context, const JsonNode& filename, bool raw);

}  // namespace stokes
