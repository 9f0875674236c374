// What a page and a viewer are sent, where a camera goes, who may ask, and when a file has changed. No network.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "layout.h"
#include "view/frame.h"
#include "view/local_only.h"
#include "view/orbit.h"
#include "view/pages.h"
#include "view/report.h"
#include "view/server.h"
#include "view/state_json.h"
#include "view/tev.h"
#include "view/tev_packets.h"
#include "view/watch.h"

namespace stokes {
namespace {

using testing::HasSubstr;
using testing::Not;

float of_half(std::uint16_t half) {
  const int exponent = (half >> 10) & 31, fraction = half & 1023;
  const float magnitude = exponent == 31 ? (fraction ? NAN : INFINITY) : exponent ? std::ldexp(1.0f + float(fraction) / 1024, exponent - 15) : std::ldexp(float(fraction), -24);
  return half & 0x8000 ? -magnitude : magnitude;
}

TEST(Half, EveryHalfComesBack) {
  for (unsigned h = 0; h < 65536; h++) {
    const float value = of_half(static_cast<std::uint16_t>(h));
    if (!std::isnan(value)) {
      ASSERT_EQ(half_of(value), h);
    }
  }
  EXPECT_TRUE(std::isnan(of_half(half_of(NAN))));
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  for (unsigned h = 0; h < 0x7bff; h++) {
    const float a = of_half(static_cast<std::uint16_t>(h)), b = of_half(static_cast<std::uint16_t>(h + 1)), middle = 0.5f * (a + b);
    ASSERT_EQ(half_of(middle), h % 2 == 0 ? h : h + 1);
    ASSERT_EQ(half_of(std::nextafter(middle, a)), h);
    ASSERT_EQ(half_of(std::nextafter(middle, b)), h + 1);
  }
  EXPECT_EQ(half_of(65519.0f), 0x7bff);
  EXPECT_EQ(half_of(65520.0f), 0x7c00);
  EXPECT_EQ(half_of(-1e30f), 0xfc00);
}

Film two_pixels() {
  Film film = make_film(2, 1, 0, 0, 2, 1, FILM_FLUORESCENCE | FILM_FLUORESCENT_BINS, 5, 280, 780, std::ldexp(1.0, -30), 1);
  const double rgb[3] = {4000, 1, -0.25}, aovs[4] = {1000, 0.5, 0, 8}, bins[10] = {1, 2, 3, 4, 5, 0, 0, 1, 2, 0};
  const double black[3] = {}, nothing[10] = {};
  for (int i = 0; i < 2; i++) {
    film_add(film, 1, 0, rgb, 1, aovs, bins);
    film_add(film, 0, 0, black, 0, nothing, nothing);
  }
  return film;
}

std::vector<float> decode(const std::string& bytes) {
  std::int32_t exponent = 0;
  std::memcpy(&exponent, bytes.data() + 20, 4);
  std::vector<float> values;
  for (std::size_t i = 32; i < bytes.size(); i += 2) {
    std::uint16_t half = 0;
    std::memcpy(&half, bytes.data() + i, 2);
    values.push_back(std::ldexp(of_half(half), exponent));
  }
  return values;
}

TEST(Frame, HoldsTheLayers) {
  const Film film = two_pixels();
  const std::string bytes = encode_frame(film, "picture", 2, 7);
  ASSERT_EQ(bytes.size(), 32u + 2 * 3 * 2);
  EXPECT_EQ(bytes.substr(0, 4), "STKF");
  EXPECT_EQ(decode(bytes), (std::vector<float>{0, 0, 0, 4000, 1, -0.25}));
  EXPECT_EQ(decode(encode_frame(film, "reflected", 2, 7)), (std::vector<float>{0, 0, 0, 3000, 0.5, -0.25}));
  EXPECT_EQ(decode(encode_frame(film, "noise", 2, 7)), (std::vector<float>(6, 0)));
  EXPECT_THROW(encode_frame(film, "albedo", 2, 7), std::invalid_argument);
  EXPECT_EQ(frame_layers(film.channels), (std::vector<std::string>{"picture", "fluorescence", "reflected", "noise"}));
}

TEST(Frame, ProbesOnePixel) {
  const Probe probe = probe_film(two_pixels(), 1, 0);
  EXPECT_EQ(probe.samples, 2);
  EXPECT_EQ(probe.spectrum, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(probe.fluorescent, (std::vector<double>{0, 0, 1, 2, 0}));
  EXPECT_DOUBLE_EQ(probe.energy, 1500);
  EXPECT_DOUBLE_EQ(probe.fluorescent_energy, 300);
  EXPECT_THAT(to_json(probe), HasSubstr("\"spectrum\":[1.0,2.0,3.0,4.0,5.0]"));
}

TEST(Frame, ProbesTheMeanOfASquare) {
  // Of the square's nine pixels the film has two, one of them black.
  const Probe probe = probe_film(two_pixels(), 1, 0, 1);
  EXPECT_EQ(probe.spectrum, (std::vector<double>{0.5, 1, 1.5, 2, 2.5}));
  EXPECT_EQ(probe.fluorescent, (std::vector<double>{0, 0, 0.5, 1, 0}));
  EXPECT_DOUBLE_EQ(probe.rgb[0], 2000);
  EXPECT_DOUBLE_EQ(probe.fluorescent_energy, 150);
}

CameraDescription looking_down_z() {
  CameraDescription camera;
  camera.transform.m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5};  // at (0, 0, 5), towards -z
  return camera;
}

void expect_near(Vec3d a, Vec3d b) { EXPECT_LT(length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z; }

TEST(Orbit, TurnsAboutItsCentre) {
  Orbit orbit(looking_down_z(), 5);
  orbit.turn(0.5 * M_PI, 0);
  expect_near(orbit.camera().transform.translation(), {5, 0, 0});
  expect_near(orbit.camera().transform.column(2), {1, 0, 0});  // looks along -x
  expect_near(orbit.camera().transform.column(1), {0, 1, 0});
  orbit.zoom(0.5);
  expect_near(orbit.camera().transform.translation(), {2.5, 0, 0});
  orbit.reset();
  orbit.turn(0, 0.25 * M_PI);
  expect_near(orbit.camera().transform.translation(), Vec3d{0, 5, 5} / std::sqrt(2.0));
  orbit.turn(0, 10);
  EXPECT_GT(orbit.camera().transform.column(1).y, 0) << "never over the pole";
  EXPECT_GT(orbit.camera().transform.translation().y, 4.99);
}

TEST(Orbit, ShiftsByThePicturesHeightAndComesBackExactly) {
  Orbit orbit(looking_down_z(), 5);  // 90 degrees: 10 units high at the centre
  orbit.shift(0.5, -0.1);
  expect_near(orbit.camera().transform.translation(), {5, -1, 5});
  EXPECT_TRUE(orbit.moved());
  orbit.reset();
  EXPECT_FALSE(orbit.moved());
  EXPECT_EQ(orbit.camera().transform.m, looking_down_z().transform.m);
}

TEST(LocalOnly, NamesOfThisMachineAndNoOthers) {
  for (const char* host : {"localhost", "localhost:7280", "127.0.0.1:1", "[::1]:65535", "127.0.0.1"}) EXPECT_TRUE(is_local_host(host)) << host;
  for (const char* host : {"", "example.com", "localhost.example.com", "127.0.0.1.example.com:80", "127.0.0.1:", "localhost:80x", "127.0.0.1:123456", "192.168.0.1"})
    EXPECT_FALSE(is_local_host(host)) << host;
  EXPECT_TRUE(is_same_origin("", "localhost:7280"));
  EXPECT_TRUE(is_same_origin("http://localhost:7280", "localhost:7280"));
  for (const char* origin : {"http://localhost:8000", "https://localhost:7280", "null", "http://example.com"}) EXPECT_FALSE(is_same_origin(origin, "localhost:7280")) << origin;
}

TEST(Tev, PacketsAreThoseOfItsOwnClient) {
  const std::string name = "box \xc3\xa9.json";
  const std::vector<std::string> channels = {"R", "G", "B", "A"};
  std::vector<float> values;
  for (int i = 0; i < 24; i++) values.push_back(float(i - 5) / 4);
  EXPECT_EQ(tev::create_image(name, 300, 200, channels, true), test::kCreate);
  EXPECT_EQ(tev::update_image(name, 128, 7, 3, 2, channels, values, false), test::kUpdate);
  EXPECT_EQ(tev::close_image(name), test::kClose);
}

TEST(FileWatch, TellsOnceWhenTheFilesStandStillAgain) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "stokes_watch";
  std::filesystem::create_directories(folder);
  const std::string a = folder / "a", b = folder / "b";
  const auto write = [](const std::string& path, const std::string& text) { std::ofstream(path) << text; };
  write(a, "1");
  std::filesystem::remove(b);
  FileWatch watch;
  watch.watch({a, b});
  EXPECT_FALSE(watch.changed());
  write(a, "12");
  EXPECT_FALSE(watch.changed()) << "it may still be being written";
  write(a, "123");
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed());
  EXPECT_FALSE(watch.changed());
  // Written beside and renamed over, as many editors do; and a file that was missing.
  write(folder / "c", "123");
  std::filesystem::rename(folder / "c", a);
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed());
  write(b, "");
  EXPECT_FALSE(watch.changed());
  EXPECT_TRUE(watch.changed());
  std::filesystem::remove_all(folder);
}

TEST(State, AnErrorBringsItsLine) {
  const std::string path = testing::TempDir() + "stokes_state.json";
  std::ofstream(path) << "{\n  \"camera\": 3\n}\n";
  SessionState state;
  state.error = path + ":2:13: error: /camera: expected an object";
  const std::string json = to_json(state);
  EXPECT_THAT(json, HasSubstr("\"line\":2,\"column\":13,\"text\":\"/camera: expected an object\",\"source\":\"  \\\"camera\\\": 3\""));
  state.error = "the device is gone: CL_OUT_OF_RESOURCES";
  EXPECT_THAT(to_json(state), HasSubstr("{\"message\":\"the device is gone: CL_OUT_OF_RESOURCES\"}"));
  std::filesystem::remove(path);
}

TEST(Page, NeedsNothingFromOutside) {
  for (const auto& [name, page] : page_files()) {
    for (const char* foreign : {"http://", "https://", " src=", "@import", "url(", "<!-- include"}) EXPECT_THAT(page, Not(HasSubstr(foreign))) << name;
    EXPECT_THAT(page, HasSubstr("</html>")) << name;
  }
  EXPECT_THAT(page_files().at("viewer.html"), HasSubstr("new EventSource(\"/events\")"));
}

Image tiny(float r, float variance) {
  Image image;
  image.width = 3;
  image.height = 1;
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, {r, 1, 2}});
  for (const char* name : {"Variance.R", "Variance.G", "Variance.B"}) image.channels.push_back({name, {variance, variance, variance}});
  image.channels.push_back({spectral_channel_name(450), {1, 2, 3}});
  image.channels.push_back({spectral_channel_name(550), {4, 5, 6}});
  return image;
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(std::strchr(digits, c) - digits);
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

TEST(Report, HoldsPicturesScoresAndSpectra) {
  ReportCase c{"</script><b>", "a", "b", tiny(3, 0.5f), tiny(1, 0.5f), {}, std::nullopt, true, {{1, 0.5}, {4, 0.25}}};
  c.difference = compare_images(c.a, c.b);
  const std::string page = comparison_report("<title>", {c});
  for (const char* foreign : {"http://", "https://", " src=", "@import", "url(", "<!-- ", "<b>", "EventSource"}) EXPECT_THAT(page, Not(HasSubstr(foreign)));
  const auto field = [&](const std::string& key) {
    const std::size_t at = page.find("\"" + key + "\":\"") + key.size() + 4;
    return decode(from_base64(page.substr(at, page.find('"', at) - at)));
  };
  EXPECT_EQ(field("a"), (std::vector<float>{3, 3, 3, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(field("z"), (std::vector<float>{2, 0, 0}));
  EXPECT_THAT(page, HasSubstr("\"spectra\":{\"begin\":400.0,\"end\":600.0,\"edge\":1,"));
  EXPECT_THAT(page, HasSubstr("\"convergence\":[[1,0.5],[4,0.25]]"));
}

// Errors of films with known noise: each of n samples is 1 +- 1, the truth is 1 with 2 samples of its own.
TEST(Report, TheTruthsOwnNoiseIsNoError) {
  const auto film_of = [](std::initializer_list<double> values) {
    Film film = make_film(1, 1, 0, 0, 1, 1, 0, 0, 0, 0, std::ldexp(1.0, -20), 1);
    for (const double v : values) {
      const double rgb[3] = {v, v, v};
      film_add(film, 0, 0, rgb, 1, nullptr, nullptr);
    }
    return film;
  };
  const Film truth = film_of({0.5, 1.5});  // the variance of its mean is 1/4
  EXPECT_DOUBLE_EQ(convergence_error(film_of({3}), truth), std::sqrt(4 - 0.25));
  EXPECT_DOUBLE_EQ(convergence_error(film_of({1, 1}), truth), 0);

  // Where the pixels' errors scatter more than they are, nothing is told.
  Film noisy = make_film(4, 1, 0, 0, 4, 1, 0, 0, 0, 0, std::ldexp(1.0, -20), 1), plain = noisy, sure = noisy;
  for (int x = 0; x < 4; x++) {
    for (const double v : {0.5, 1.5}) {
      const double truth_rgb[3] = {v, v, v}, edge = x == 0 ? 3.0 : 1.0, near[3] = {edge, edge, edge}, far[3] = {3, 3, 3};
      film_add(noisy, x, 0, truth_rgb, 1, nullptr, nullptr);
      film_add(plain, x, 0, near, 1, nullptr, nullptr);
      film_add(sure, x, 0, far, 1, nullptr, nullptr);
    }
  }
  EXPECT_EQ(convergence_error(plain, noisy), 0);
  EXPECT_DOUBLE_EQ(convergence_error(sure, noisy), std::sqrt(4 - 0.25));
}

}  // namespace
}  // namespace stokes
