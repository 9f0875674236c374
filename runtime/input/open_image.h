// Image files by the few readers that are meant to be reachable. Knows signatures of formats, not what images are for.
#pragma once
#include <memory>
#include <string>

#include "input/image_codec.h"

namespace stokes {

/// The reader for a file's content by its first bytes (never by its name, which a stranger chose): "png", "jpeg", "openexr", "hdr", "tiff",
/// "pnm", "bmp"; "targa", which has no signature, by a plausible header and the name. Empty: none of these.
std::string image_format(const std::string& path);

/// Opens a regular file with that one reader; its pixels are not yet read. See ImageCodec::open. Throws std::runtime_error with the reason.
std::unique_ptr<ImageReader> open_image(const std::string& path, bool straight_alpha = false);

}  // namespace stokes
