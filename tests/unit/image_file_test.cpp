// EXR and PNG: what is written is what is read, and a failed write leaves the old file.
#include "image/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "image/error.h"
#include "image/film_file.h"
#include "image/replace_file.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "stokes-image-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (fs::path(folder_) / name).string(); }
  std::string folder_;
};

Image make_image(int width, int height, const std::vector<std::string>& names) {
  Image image;
  image.width = width;
  image.height = height;
  float value = -3.1f;
  for (const std::string& name : names) {
    Image::Channel channel{name, {}};
    for (int i = 0; i < width * height; i++) channel.values.push_back(value *= -1.37f);
    image.channels.push_back(channel);
  }
  return image;
}

TEST_F(ImageFile, ExrKeepsEveryFloatChannelAndAttribute) {
  Image image = make_image(5, 3, {"R", "G", "B", "A", "Z", "N.X", "Variance.G", "S0.550,000000nm"});
  image.x = 2;
  image.y = 1;
  image.full_width = 9;
  image.full_height = 7;
  image.metadata = {{"spectralLayoutVersion", "1.0"}, {"emissiveUnits", "W.m^-2.sr^-1"}, {"stokes:seed", "42"}};
  write_exr(path("a.exr"), image);
  const Image back = read_image(path("a.exr"));
  ASSERT_EQ(back.channels.size(), image.channels.size());
  for (const Image::Channel& channel : image.channels) {
    ASSERT_NE(back.find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(back.find(channel.name)->values, channel.values) << channel.name;
  }
  EXPECT_EQ(back.x, 2);
  EXPECT_EQ(back.full_height, 7);
  for (const auto& entry : image.metadata) EXPECT_THAT(back.metadata, ::testing::Contains(entry));
}

TEST_F(ImageFile, APartsTailIsInvisibleToReaders) {
  const Image image = make_image(4, 4, {"R", "G", "B", "A"});
  FilmRecord record;
  record.identity = {"v", "h", "s", "d", "i", 1};
  record.film = make_film(4, 4, 0, 0, 4, 4, 0, 0, 0, 0, 1, 1);
  write_exr(path("part.exr"), image, encode_film(record));
  EXPECT_EQ(read_image(path("part.exr")).find("G")->values, image.find("G")->values);
  EXPECT_EQ(read_film(path("part.exr")).film.words, record.film.words);
  write_exr(path("plain.exr"), image);
  EXPECT_FALSE(holds_film(path("plain.exr")));
  EXPECT_THROW(read_film(path("plain.exr")), InputError);
}

TEST_F(ImageFile, PngIsSrgbExposedAndInGamut) {
  Image image;
  image.width = 4;
  image.height = 1;
  image.channels = {{"R", {0.25f, 4.0f, 0.5f, 0.0f}}, {"G", {0.25f, 0.0f, 0.5f, -1.0f}}, {"B", {0.25f, 0.0f, -0.1f, 0.0f}}};
  write_png(path("a.png"), image, 1);
  const Image back = read_image(path("a.png"));
  const auto byte = [&](const char* name, std::size_t i) {
    return std::lround(255 * srgb_encode(static_cast<double>(back.find(name)->values[i])));
  };
  EXPECT_EQ(byte("R", 0), std::lround(255 * srgb_encode(0.5)));  // one stop up
  EXPECT_EQ(byte("R", 1), 255);
  EXPECT_EQ(byte("G", 1), 0);
  // The third pixel, (1, 1, -0.2) when exposed, moves towards its own grey until blue is 0; luminance stays.
  const double luminance = 0.2126 + 0.7152 - 0.2 * 0.0722, red = luminance + luminance / (luminance + 0.2) * (1 - luminance);
  EXPECT_EQ(byte("R", 2), std::lround(255 * srgb_encode(red)));
  EXPECT_EQ(byte("B", 2), 0);
  EXPECT_EQ(byte("G", 3), 0);  // no luminance at all: black
}

TEST_F(ImageFile, AFailedWriteLeavesTheOldFileAndNoOther) {
  std::ofstream(path("old.exr")) << "old";
  EXPECT_THROW(replace_file(path("old.exr"),
                            [](const std::string& temporary) {
                              std::ofstream(temporary) << "half";
                              throw std::runtime_error("disk full");
                            }),
               OutputError);
  std::ifstream file(path("old.exr"));
  std::string text;
  file >> text;
  EXPECT_EQ(text, "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ImageFile, ReplacingFollowsLinksAndRefusesWhatIsNoFile) {
  write_bytes(path("real"), "1");
  fs::create_symlink("real", path("link"));
  write_bytes(path("link"), "2");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  std::ifstream file(path("real"));
  EXPECT_EQ(file.get(), '2');
  EXPECT_THROW(write_bytes(folder_, "x"), OutputError);
  EXPECT_THROW(write_bytes("/dev/null", "x"), OutputError);
  EXPECT_THROW(write_bytes(path("no/such/folder/x"), "x"), OutputError);
  EXPECT_THROW(require_writable(path("no/such/x")), OutputError);
  EXPECT_NO_THROW(require_writable(path("new")));
  EXPECT_FALSE(fs::exists(path("new")));
}

TEST_F(ImageFile, ReadingWhatIsNoImageNamesTheFile) {
  std::ofstream(path("x.exr")) << "not an image";
  try {
    read_image(path("x.exr"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("x.exr"), std::string::npos);
  }
}

}  // namespace
}  // namespace stokes
