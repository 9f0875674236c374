// Images to EXR and PNG files and back. Knows images, nothing of films or scenes.
#include "image/image_file.h"

#include <algorithm>
#include <cmath>

#include "image/error.h"
#include "image/replace_file.h"
#include "input/limits.h"
#include "input/open_image.h"

namespace stokes {
namespace {

std::size_t pixel_count(const Image& image) { return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height); }

std::string encode(const char* format, const ImageHeader& header, const void* pixels) {
  try {
    return image_codec().encode(format, header, pixels);
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
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

void require_image_writer() {
  try {
    find_image_codec();
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

void write_exr(const std::string& path, const Image& image, const std::string& tail) {
  ImageHeader header;
  header.width = image.width;
  header.height = image.height;
  header.x = image.x;
  header.y = image.y;
  header.full_width = image.full_width > 0 ? image.full_width : image.width;
  header.full_height = image.full_height > 0 ? image.full_height : image.height;
  for (const Image::Channel& channel : image.channels) header.channels.push_back(channel.name);
  header.attributes = image.metadata;

  std::vector<float> pixels(pixel_count(image) * image.channels.size());
  for (std::size_t c = 0; c < image.channels.size(); c++)
    for (std::size_t i = 0; i < pixel_count(image); i++) pixels[i * image.channels.size() + c] = image.channels[c].values[i];
  write_bytes(path, encode("openexr", header, pixels.data()) + tail);
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
  ImageHeader header;
  header.width = header.full_width = image.width;
  header.height = header.full_height = image.height;
  header.sample = ImageHeader::Sample::UInt8;
  header.channels = {"R", "G", "B"};
  write_bytes(path, encode("png", header, pixels.data()));
}

Image read_image(const std::string& path) {
  try {
    const auto in = open_image(path);
    const ImageHeader& header = in->header();
    const std::size_t channels = header.channels.size();
    const std::uint64_t values = static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height) * channels;
    require_memory({}, 2 * sizeof(float) * values, path);  // as they lie in the file, and by channel
    Image image;
    image.width = header.width;
    image.height = header.height;
    image.x = header.x;
    image.y = header.y;
    image.full_width = header.full_width;
    image.full_height = header.full_height;
    image.metadata = header.attributes;
    std::vector<float> pixels(pixel_count(image) * channels);
    in->read(static_cast<int>(channels), pixels.data());
    for (std::size_t c = 0; c < channels; c++) {
      Image::Channel channel{header.channels[c], std::vector<float>(pixel_count(image))};
      const bool encoded = header.sample == ImageHeader::Sample::UInt8 && channel.name != "A";
      for (std::size_t i = 0; i < pixel_count(image); i++) {
        const float value = pixels[i * channels + c];
        channel.values[i] = encoded ? static_cast<float>(srgb_decode(static_cast<double>(value))) : value;
      }
      image.channels.push_back(std::move(channel));
    }
    return image;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(path + ": cannot be read: " + error.what());
  }
}

}  // namespace stokes
