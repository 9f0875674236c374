// Image files by OpenImageIO, the only place of the scene library that knows it.
#include "scene/image_file.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <stdexcept>

namespace stokes {
namespace {

constexpr int kMaxSide = 32768;

float decode_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

}  // namespace

ImagePixels read_image_file(const std::string& path, bool raw) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &config);
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kMaxSide || spec.height > kMaxSide || spec.nchannels < 1 || spec.depth > 1)
    throw std::runtime_error("the image has no usable size");
  const bool integer = spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;

  // Grey (with or without alpha) has one channel of colour, everything else its first three.
  const int channels = spec.nchannels < 3 ? 1 : 3;
  std::vector<float> pixels(static_cast<std::size_t>(spec.width) * spec.height * channels);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels.data())) throw std::runtime_error(input->geterror());

  ImagePixels image{spec.width, spec.height, {}};
  image.rgb.resize(static_cast<std::size_t>(spec.width) * spec.height * 3);
  for (std::size_t i = 0; i < image.rgb.size(); i++) {
    const float v = pixels[channels == 3 ? i : i / 3];
    if (!std::isfinite(v)) throw std::runtime_error("a pixel is not a finite number");
    image.rgb[i] = integer && !raw ? decode_srgb(v) : v;
  }
  return image;
}

}  // namespace stokes
