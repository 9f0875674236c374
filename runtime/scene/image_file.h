// Image files as linear sRGB pixels. Knows how pixels are coded, not scenes.
#pragma once
#include <string>

#include "input/limits.h"
#include "scene/description.h"

namespace stokes {

/// Reads the first image of a file as linear sRGB. 8- and 16-bit integer files are decoded from sRGB unless `raw`; float files are
/// linear already. Grey images become three equal channels, alpha is dropped. Throws std::runtime_error with the reason; OutOfMemory.
ImagePixels read_image_file(const std::string& path, bool raw, const InputLimits& limits);

}  // namespace stokes
