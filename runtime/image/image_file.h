// Images to EXR and PNG files and back. Knows images, nothing of films or scenes.
#pragma once
#include <string>

#include "image/film.h"

namespace stokes {

/// Throws OutputError where the part of the program that writes images is missing, which is looked for but not loaded (see input/image_codec.h).
void require_image_writer();

/// Writes an EXR: float32, ZIP, all channels, metadata as string attributes, the window as data window inside the full image.
/// `tail`, when not empty, follows the end of the EXR, where EXR readers do not look. Throws OutputError.
void write_exr(const std::string& path, const Image& image, const std::string& tail = {});

/// Writes R, G, B as an 8-bit sRGB PNG after scaling by 2^exposure. Negative components are brought into the gamut by desaturation
/// at the same luminance; what is over 1 is clipped. Throws OutputError.
void write_png(const std::string& path, const Image& image, double exposure);

/// Reads an image of any format that open_image knows, as floats with its channel names. 8-bit files are decoded from sRGB. Throws InputError.
Image read_image(const std::string& path);

/// A linear value to sRGB's encoding, both in [0, 1].
double srgb_encode(double linear);
double srgb_decode(double encoded);

}  // namespace stokes
