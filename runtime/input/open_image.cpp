// Signatures of image files, and the one reader that each leads to. OpenImageIO itself would try all it has, film and font
// readers among them.
#include "input/open_image.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "input/quiet_stderr.h"

namespace stokes {
namespace {

struct Signature {
  std::string_view bytes;
  const char* format;
};

constexpr Signature kSignatures[] = {
    {std::string_view("\x89PNG\r\n\x1a\n", 8), "png"},
    {std::string_view("\xff\xd8\xff", 3), "jpeg"},
    {std::string_view("\x76\x2f\x31\x01", 4), "openexr"},
    {std::string_view("#?RADIANCE", 10), "hdr"},
    {std::string_view("#?RGBE", 6), "hdr"},
    {std::string_view("II*\0", 4), "tiff"},
    {std::string_view("MM\0*", 4), "tiff"},
    {std::string_view("BM", 2), "bmp"},
};

// P1 to P6 and the float maps PF and Pf, each followed by white space.
bool is_pnm(std::string_view head) {
  if (head.size() < 3 || head[0] != 'P' || !std::isspace(static_cast<unsigned char>(head[2]))) return false;
  return (head[1] >= '1' && head[1] <= '6') || head[1] == 'F' || head[1] == 'f';
}

// Targa: no or one colour map, a known kind of picture, a known depth, and its own extension.
bool is_targa(std::string_view head, const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".tga" || head.size() < 18) return false;
  const int kind = head[2], depth = head[16];
  const bool known = (kind >= 1 && kind <= 3) || (kind >= 9 && kind <= 11);
  return head[1] >= 0 && head[1] <= 1 && known && (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32);
}

/// What libraries say while a file is read, they say by exceptions only.
class QuietReader : public ImageReader {
 public:
  explicit QuietReader(std::unique_ptr<ImageReader> reader) : reader_(std::move(reader)) {}
  const ImageHeader& header() const override { return reader_->header(); }
  void read(int channels, float* pixels) override {
    const QuietStderr quiet;
    reader_->read(channels, pixels);
  }

 private:
  std::unique_ptr<ImageReader> reader_;
};

}  // namespace

std::string image_format(const std::string& path) {
  std::array<char, 18> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view head(bytes.data(), static_cast<std::size_t>(file.gcount()));
  for (const Signature& s : kSignatures)
    if (head.starts_with(s.bytes)) return s.format;
  if (is_pnm(head)) return "pnm";
  return is_targa(head, path) ? "targa" : "";
}

std::unique_ptr<ImageReader> open_image(const std::string& path, bool straight_alpha) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw std::runtime_error(std::filesystem::exists(path, error) ? "it is no regular file" : "there is no such file");
  const std::string format = image_format(path);
  if (format.empty()) throw std::runtime_error("it is none of PNG, JPEG, OpenEXR, HDR, TIFF, PNM, BMP and Targa");
  const ImageCodec& codec = image_codec();
  const QuietStderr quiet;
  auto reader = codec.open(path, format, straight_alpha);
  const ImageHeader& header = reader->header();
  if (header.width < 1 || header.height < 1 || header.channels.empty()) throw std::runtime_error("the image has no usable size");
  return std::make_unique<QuietReader>(std::move(reader));
}

}  // namespace stokes
