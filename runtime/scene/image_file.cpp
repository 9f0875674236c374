// Pixels of image files, decoded to linear sRGB.
#include "scene/image_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "input/open_image.h"

namespace stokes {
namespace {

float decode_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

constexpr std::uint64_t kMostPixelsAByte = 250'000;  // more than any format's densest picture of one colour has

// The pixels as they come and as they are kept; texels are counted with the scene.
void require_size(const ImageHeader& header, const std::string& path, const InputLimits& limits) {
  const auto width = static_cast<std::uint64_t>(header.width), height = static_cast<std::uint64_t>(header.height);
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels, and the limit ";
  if (std::max(width, height) > limits.image_side)
    throw std::runtime_error("it has " + size + "of a side is " + std::to_string(limits.image_side) + " (--limit image-side)");
  if (width * height > limits.image_pixels)
    throw std::runtime_error("it has " + size + "is " + std::to_string(limits.image_pixels) + " (--limit image-pixels)");
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && width * height / kMostPixelsAByte > bytes)
    throw std::runtime_error("its header says " + std::to_string(width) + "x" + std::to_string(height) + " pixels, and the file has " + std::to_string(bytes) + " bytes");
  require_memory(limits, width * height * 6 * sizeof(float), path);
}

}  // namespace

ImagePixels read_image_file(const std::string& path, bool raw, const InputLimits& limits) {
  const auto input = open_image(path, /*straight_alpha=*/true);
  const ImageHeader& header = input->header();
  require_size(header, path, limits);
  const bool integer = header.sample != ImageHeader::Sample::Float;

  // Grey (with or without alpha) has one channel of colour, everything else its first three.
  const int channels = header.channels.size() < 3 ? 1 : 3;
  std::vector<float> pixels(static_cast<std::size_t>(header.width) * header.height * channels);
  input->read(channels, pixels.data());

  ImagePixels image{header.width, header.height, {}};
  image.rgb.resize(static_cast<std::size_t>(header.width) * header.height * 3);
  for (std::size_t i = 0; i < image.rgb.size(); i++) {
    const float v = pixels[channels == 3 ? i : i / 3];
    if (!std::isfinite(v)) throw std::runtime_error("a pixel is not a finite number");
    image.rgb[i] = integer && !raw ? decode_srgb(v) : v;
  }
  return image;
}

}  // namespace stokes
