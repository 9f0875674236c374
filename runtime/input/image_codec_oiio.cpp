// The module of image files: all that the project asks of OpenImageIO. Knows formats by OpenImageIO's names, not what images are for.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <stdexcept>

#include "input/image_codec.h"

namespace stokes {
namespace {

// OpenImageIO's messages may have several lines.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "OpenImageIO gives no reason" : text;
}

class OiioReader : public ImageReader {
 public:
  OiioReader(const std::string& path, const std::string& format, bool straight_alpha) : input_(OIIO::ImageInput::create(format)) {
    if (!input_) throw std::runtime_error("OpenImageIO has no reader for " + format + ": " + one_line(OIIO::geterror()));
    OIIO::ImageSpec spec, config;
    if (straight_alpha) config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input_->open(path, spec, config)) throw std::runtime_error(one_line(input_->geterror()));
    if (spec.deep || spec.depth > 1) throw std::runtime_error("deep images and volumes cannot be used");
    header_.width = spec.width;
    header_.height = spec.height;
    header_.x = spec.x;
    header_.y = spec.y;
    header_.full_width = spec.full_width;
    header_.full_height = spec.full_height;
    header_.sample = spec.format == OIIO::TypeDesc::UINT8    ? ImageHeader::Sample::UInt8
                     : spec.format == OIIO::TypeDesc::UINT16 ? ImageHeader::Sample::UInt16
                                                             : ImageHeader::Sample::Float;
    header_.channels = spec.channelnames;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) header_.attributes.emplace_back(attribute.name().string(), attribute.get_string());
  }
  const ImageHeader& header() const override { return header_; }
  void read(int channels, float* pixels) override {
    if (!input_->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels)) throw std::runtime_error(one_line(input_->geterror()));
  }

 private:
  std::unique_ptr<OIIO::ImageInput> input_;
  ImageHeader header_;
};

class OiioCodec : public ImageCodec {
 public:
  std::unique_ptr<ImageReader> open(const std::string& path, const std::string& format, bool straight_alpha) const override {
    return std::make_unique<OiioReader>(path, format, straight_alpha);
  }

  std::string encode(const std::string& format, const ImageHeader& header, const void* pixels) const override {
    const bool bytes = header.sample == ImageHeader::Sample::UInt8;
    const OIIO::TypeDesc type = bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()), type);
    spec.x = header.x;
    spec.y = header.y;
    spec.full_width = header.full_width;
    spec.full_height = header.full_height;
    spec.channelnames = header.channels;
    spec.alpha_channel = -1;
    spec.z_channel = -1;
    spec.attribute("oiio:ColorSpace", bytes ? "sRGB" : "Linear");
    if (format == "openexr") spec.attribute("compression", "zip");
    for (const auto& [name, value] : header.attributes) spec.attribute(name, value);

    auto out = OIIO::ImageOutput::create(format);
    if (!out) throw std::runtime_error("OpenImageIO has no writer for " + format + ": " + one_line(OIIO::geterror()));
    // In memory, because writers to files do not notice a disk that fills up at the last block.
    OIIO::Filesystem::IOVecOutput memory;
    if (!out->set_ioproxy(&memory) || !out->open("image." + format, spec) || !out->write_image(type, pixels) || !out->close())
      throw std::runtime_error("no " + format + " can be made: " + one_line(out->geterror()));
    return {memory.buffer().begin(), memory.buffer().end()};
  }
};

}  // namespace
}  // namespace stokes

/// ImageCodecFunction.
extern "C" const stokes::ImageCodec* stokes_image_codec() {
  static const stokes::OiioCodec codec;
  return &codec;
}
