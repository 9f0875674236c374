// How image files are decoded and encoded: the boundary between the program and the module (image_codec_oiio.cpp) that links OpenImageIO.
// Loading OpenImageIO and the 250 libraries behind it takes longer than all else a command does before its first pixel, so the module is loaded
// when the first image is read or written.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace stokes {

/// What an image file says of its pixels.
struct ImageHeader {
  enum class Sample { UInt8, UInt16, Float };  ///< Float: everything that is not one of the others
  int width = 0, height = 0;
  int x = 0, y = 0;                            ///< the window's place in the full image
  int full_width = 0, full_height = 0;
  Sample sample = Sample::Float;
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// An image file that is open; its pixels are not yet read.
class ImageReader {
 public:
  virtual ~ImageReader() = default;
  virtual const ImageHeader& header() const = 0;
  /// The first `channels` channels of all pixels, row by row, as floats (integers over their range). Throws std::runtime_error with the reason, in one line.
  virtual void read(int channels, float* pixels) = 0;
};

/// What the module exports. Its functions throw std::runtime_error with a reason in one line.
class ImageCodec {
 public:
  /// Opens a file with the reader of one format, by OpenImageIO's name. Deep and volume images are refused. Colours are as they lie in the
  /// file where `straight_alpha`, else multiplied by alpha.
  virtual std::unique_ptr<ImageReader> open(const std::string& path, const std::string& format, bool straight_alpha) const = 0;
  /// A file's bytes: UInt8 (unsigned char) or Float (float) pixels, row by row. EXR files are ZIP-compressed.
  virtual std::string encode(const std::string& format, const ImageHeader& header, const void* pixels) const = 0;

 protected:
  ~ImageCodec() = default;
};

constexpr const char* kImageCodecModule = "libstokes_image_codec.so";
constexpr const char* kImageCodecSymbol = "stokes_image_codec";
using ImageCodecFunction = const ImageCodec* (*)();

/// The module, which the first call loads. Throws std::runtime_error where it cannot be.
const ImageCodec& image_codec();
/// The path of its file, which is not loaded: for whoever will need it hours later. Throws std::runtime_error where there is none.
std::string find_image_codec();

}  // namespace stokes
