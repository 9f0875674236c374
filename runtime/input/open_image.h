// Image files by the few readers that are meant to be reachable. Knows OpenImageIO's names of formats, not what images are for.
#pragma once
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

namespace stokes {

/// The reader for a file's content by its first bytes (never by its name, which a stranger chose): "png", "jpeg", "openexr", "hdr", "tiff",
/// "pnm", "bmp"; "targa", which has no signature, by a plausible header and the name. Empty: none of these.
std::string image_format(const std::string& path);

/// Opens a regular file with that one reader; its pixels are not yet read. Deep and volume images are refused. Throws
/// std::runtime_error with the reason.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path, const OIIO::ImageSpec& config = {});

/// Reads the first `channels` channels of all pixels, row by row, as floats. Throws std::runtime_error with the reason, in one line.
void read_pixels(OIIO::ImageInput& input, int channels, float* pixels);

}  // namespace stokes
