// Images to EXR and PNG files and back, through OpenImageIO. Knows images, nothing of films or scenes.
#include "image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "image/error.h"
#include "image/replace_file.h"
#include "input/limits.h"
#include "input/open_image.h"

namespace stokes {
namespace {

std::size_t pixel_count(const Image& image) { return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height); }

/// A file's bytes. In memory, because writers to files do not notice a disk that fills up at the last block.
std::string encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels) {
  auto out = OIIO::ImageOutput::create(format);
  if (!out) throw OutputError("OpenImageIO has no writer for " + std::string(format) + ": " + OIIO::geterror());
  OIIO::Filesystem::IOVecOutput memory;
  const std::string name = std::string("image.") + format;
  if (!out->set_ioproxy(&memory) || !out->open(name, spec) || !out->write_image(type, pixels) || !out->close())
    throw OutputError("no " + std::string(format) + " can be made: " + out->geterror());
  return {memory.buffer().begin(), memory.buffer().end()};
}

/// Towards the grey of the same luminance (Rec. 709) until no component is negative.
void map_gamut(double rgb[3]) {
  const double low = std::min({rgb[0], rgb[1], rgb[2]});
  if (low >= 0) return;
  const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  const double keep = luminance > 0 ? luminance / (luminance - low) : 0;
  for (int c = 0; c < 3; c++) rgb[c] = std::max(0.0, luminance > 0 ? luminance + keep * (rgb[c] - luminance) : 0.0);
}

}  // namespace

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

void write_exr(const std::string& path, const Image& image, const std::string& tail) {
  const int channels = static_cast<int>(image.channels.size());
  OIIO::ImageSpec spec(image.width, image.height, channels, OIIO::TypeDesc::FLOAT);
  spec.x = image.x;
  spec.y = image.y;
  spec.full_width = image.full_width > 0 ? image.full_width : image.width;
  spec.full_height = image.full_height > 0 ? image.full_height : image.height;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
  spec.channelnames.clear();
  for (const Image::Channel& channel : image.channels) spec.channelnames.push_back(channel.name);
  spec.alpha_channel = -1;
  spec.z_channel = -1;

  std::vector<float> pixels(pixel_count(image) * image.channels.size());
  for (std::size_t c = 0; c < image.channels.size(); c++)
    for (std::size_t i = 0; i < pixel_count(image); i++) pixels[i * image.channels.size() + c] = image.channels[c].values[i];
  write_bytes(path, encode("openexr", spec, OIIO::TypeDesc::FLOAT, pixels.data()) + tail);
}

void write_png(const std::string& path, const Image& image, double exposure) {
  const Image::Channel* planes[3] = {image.find("R"), image.find("G"), image.find("B")};
  std::vector<unsigned char> pixels(pixel_count(image) * 3);
  const double scale = std::exp2(exposure);
  for (std::size_t i = 0; i < pixel_count(image); i++) {
    double rgb[3];
    for (int c = 0; c < 3; c++) {
      const double value = static_cast<double>(planes[c]->values[i]) * scale;
      rgb[c] = std::isfinite(value) ? value : 0.0;
    }
    map_gamut(rgb);
    for (std::size_t c = 0; c < 3; c++)
      pixels[3 * i + c] = static_cast<unsigned char>(std::lround(255 * srgb_encode(std::min(rgb[c], 1.0))));
  }
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_bytes(path, encode("png", spec, OIIO::TypeDesc::UINT8, pixels.data()));
}

Image read_image(const std::string& path) {
  std::unique_ptr<OIIO::ImageInput> in;
  try {
    in = open_image(path);
  } catch (const std::runtime_error& error) {
    throw InputError(path + ": cannot be read: " + error.what());
  }
  const OIIO::ImageSpec& spec = in->spec();
  const std::uint64_t values = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) * static_cast<std::uint64_t>(spec.nchannels);
  require_memory({}, 2 * sizeof(float) * values, path);  // as they lie in the file, and by channel
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.x = spec.x;
  image.y = spec.y;
  image.full_width = spec.full_width;
  image.full_height = spec.full_height;
  const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> pixels(pixel_count(image) * channels);
  try {
    read_pixels(*in, spec.nchannels, pixels.data());
  } catch (const std::runtime_error& error) {
    throw InputError(path + ": cannot be read: " + error.what());
  }
  const bool encoded = spec.format == OIIO::TypeDesc::UINT8;
  for (std::size_t c = 0; c < channels; c++) {
    Image::Channel channel{spec.channelnames[c], std::vector<float>(pixel_count(image))};
    for (std::size_t i = 0; i < pixel_count(image); i++) {
      const float value = pixels[i * channels + c];
      channel.values[i] = encoded && channel.name != "A" ? static_cast<float>(srgb_decode(static_cast<double>(value))) : value;
    }
    image.channels.push_back(std::move(channel));
  }
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    image.metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return image;
}

}  // namespace stokes
