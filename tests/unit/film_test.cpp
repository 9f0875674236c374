// The film's promises: sums do not depend on the order or the split, squares need 128 bits, and records survive or are refused.
#include "image/film.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "image/error.h"
#include "image/film_file.h"
#include "layout.h"

namespace stokes {
namespace {

constexpr unsigned kAll = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH | FILM_FLUORESCENCE;

Film small_film() { return make_film(8, 6, 2, 1, 4, 3, kAll, 2, 400, 500, std::ldexp(1.0, -20), std::ldexp(1.0, -16)); }

struct Sample {
  int x, y;
  double rgb[3], alpha, aovs[11], bins[2];
};

std::vector<Sample> make_samples(int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 3);
  std::vector<Sample> samples;
  for (int i = 0; i < count; i++) {
    Sample s{i % 4, (i / 4) % 3, {u(random), u(random), u(random)}, 1, {}, {u(random), u(random)}};
    for (double& v : s.aovs) v = u(random);
    samples.push_back(s);
  }
  return samples;
}

void add(Film& film, const Sample& s) { film_add(film, s.x, s.y, s.rgb, s.alpha, s.aovs, s.bins); }

TEST(Film, SumsDoNotDependOnTheOrder) {
  std::vector<Sample> samples = make_samples(600);
  Film forward = small_film(), shuffled = small_film();
  for (const Sample& s : samples) add(forward, s);
  std::shuffle(samples.begin(), samples.end(), std::mt19937(3));
  for (const Sample& s : samples) add(shuffled, s);
  EXPECT_EQ(forward.words, shuffled.words);
}

TEST(Film, PartsAddUpToTheWhole) {
  const std::vector<Sample> samples = make_samples(600);
  Film whole = small_film(), a = small_film(), b = small_film();
  for (std::size_t i = 0; i < samples.size(); i++) {
    add(whole, samples[i]);
    add(i < 217 ? a : b, samples[i]);
  }
  ASSERT_TRUE(film_same_kind(a, b));
  film_accumulate(a, b);
  EXPECT_EQ(whole.words, a.words);
}

TEST(Film, SquaresCarryBeyond64Bits) {
  // 2^40 quanta squared is 2^80: the low word alone would hold nothing.
  Film film = make_film(1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1.0, 1.0);
  const double big[3] = {std::ldexp(1.0, 40), 0, -std::ldexp(1.0, 40)}, none[3] = {0, 0, 0};
  film_add(film, 0, 0, big, 1, nullptr, nullptr);
  film_add(film, 0, 0, none, 1, nullptr, nullptr);
  EXPECT_EQ(film.words[3], 0);
  EXPECT_EQ(film.words[4], std::int64_t{1} << 16);
  // Two samples v and 0: mean v/2, variance v^2/2, of the mean v^2/4.
  EXPECT_DOUBLE_EQ(film_mean(film, 0, 0, 0), std::ldexp(1.0, 39));
  EXPECT_DOUBLE_EQ(film_variance(film, 0, 0, 0), std::ldexp(1.0, 78));
  EXPECT_DOUBLE_EQ(film_variance(film, 0, 0, 2), std::ldexp(1.0, 78));
  EXPECT_DOUBLE_EQ(film_mean(film, 0, 0, 2), -std::ldexp(1.0, 39));
}

TEST(Film, CarryFromLowToHighWord) {
  Film film = make_film(1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1.0, 1.0);
  const double v[3] = {std::ldexp(3.0, 31), 0, 0};  // its square is 9 * 2^62: two of them carry
  for (int i = 0; i < 2; i++) film_add(film, 0, 0, v, 1, nullptr, nullptr);
  EXPECT_EQ(static_cast<std::uint64_t>(film.words[3]), std::uint64_t{1} << 63);
  EXPECT_EQ(film.words[4], 4);
  EXPECT_EQ(film_variance(film, 0, 0, 0), 0);
}

TEST(Film, VarianceOfAConstantIsExactlyZero) {
  Film film = make_film(1, 1, 0, 0, 1, 1, 0, 0, 0, 0, std::ldexp(1.0, -24), 1.0);
  const double v[3] = {0.1, 1e6 / 3, 7};
  for (int i = 0; i < 1000; i++) film_add(film, 0, 0, v, 1, nullptr, nullptr);
  for (int c = 0; c < 3; c++) EXPECT_EQ(film_variance(film, 0, 0, c), 0);
}

TEST(Film, VarianceIsThatOfTheMean) {
  Film film = make_film(1, 1, 0, 0, 1, 1, 0, 0, 0, 0, std::ldexp(1.0, -30), 1.0);
  for (int i = 1; i <= 4; i++) {
    const double v[3] = {static_cast<double>(i), 0, 0};
    film_add(film, 0, 0, v, 1, nullptr, nullptr);
  }
  EXPECT_DOUBLE_EQ(film_mean(film, 0, 0, 0), 2.5);
  EXPECT_DOUBLE_EQ(film_variance(film, 0, 0, 0), (2.25 + 0.25 + 0.25 + 2.25) / 3 / 4);
}

TEST(Film, InvalidSamplesLeaveOnlyTheirCount) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Sample good = make_samples(1)[0];
  for (int fault = 0; fault < 5; fault++) {
    Film film = small_film(), expected = small_film();
    Sample bad = good;
    if (fault == 0) bad.rgb[1] = nan;
    if (fault == 1) bad.rgb[2] = -inf;
    if (fault == 2) bad.rgb[0] = 1e30;
    if (fault == 3) bad.aovs[6] = nan;
    if (fault == 4) bad.bins[1] = inf;
    add(film, bad);
    expected.words[11] = 1;
    EXPECT_EQ(film.words, expected.words) << "fault " << fault;
    const FilmTotals totals = film_totals(film);
    EXPECT_EQ(totals.invalid, 1u);
    EXPECT_EQ(totals.first_invalid_x, 2);  // the window begins at (2, 1)
    EXPECT_EQ(totals.first_invalid_y, 1);
  }
}

TEST(Film, DevelopsEveryChannelUnderItsName) {
  Film film = small_film();
  const Sample s = {1, 2, {0.25, 0.5, -0.125}, 1, {0.1, 0.2, 0.3, 0, -1, 0, 4.5, 7, 8, 9, 10}, {2, 3}};
  add(film, s);
  add(film, s);
  const Image image = develop(film, true);
  EXPECT_EQ(image.x, 2);
  EXPECT_EQ(image.full_width, 8);
  const auto value = [&](const char* name) {
    const Image::Channel* channel = image.find(name);
    return channel ? channel->values[9] : std::numeric_limits<float>::quiet_NaN();
  };
  EXPECT_EQ(value("R"), 0.25f);
  EXPECT_EQ(value("B"), -0.125f);
  EXPECT_EQ(value("A"), 1.0f);
  EXPECT_NEAR(value("Albedo.G"), 0.2, 1e-6);
  EXPECT_EQ(value("N.Y"), -1.0f);
  EXPECT_EQ(value("Z"), 4.5f);
  EXPECT_EQ(value("Fluorescence.B"), 9.0f);
  EXPECT_EQ(value("Fluorescence.Energy"), 10.0f);
  EXPECT_EQ(value("S0.425,000000nm"), 2.0f);
  EXPECT_EQ(value("S0.475,000000nm"), 3.0f);
  EXPECT_EQ(value("Variance.R"), 0.0f);
  EXPECT_EQ(image.channels[0].values[0], 0.0f);  // no samples there
}

class FilmFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "stokes-film-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    record_.identity = {"0.1.0 (abc)", "0123456789abcdef", "a scene.json", "a device", "path tracer mis", 4294967295u};
    record_.sample_begin = 3;
    record_.sample_end = 9;
    record_.samples_total = 16;
    record_.rays = 1234567890123u;
    record_.notes = {{"stokes:driver", "1.2 = x"}};
    record_.film = small_film();
    for (const Sample& s : make_samples(100)) add(record_.film, s);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return (std::filesystem::path(folder_) / name).string(); }
  std::string folder_;
  FilmRecord record_;
};

TEST_F(FilmFile, RoundTrip) {
  write_film(path("a"), record_);
  const FilmRecord back = read_film(path("a"));
  EXPECT_EQ(back.film.words, record_.film.words);
  EXPECT_TRUE(film_same_kind(back.film, record_.film));
  EXPECT_EQ(film_mismatch(back, record_), "");
  EXPECT_EQ(back.sample_begin, 3);
  EXPECT_EQ(back.samples_total, 16);
  EXPECT_EQ(back.rays, record_.rays);
  EXPECT_EQ(back.notes, record_.notes);
  EXPECT_TRUE(holds_film(path("a")));
}

TEST_F(FilmFile, EveryDamageIsRefused) {
  const std::string bytes = encode_film(record_);
  for (std::size_t at : {std::size_t{5}, std::size_t{40}, bytes.size() / 2, bytes.size() - 30, bytes.size() - 20, bytes.size() - 12}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    std::ofstream(path("b"), std::ios::binary) << damaged;
    EXPECT_THROW(read_film(path("b")), InputError) << "byte " << at;
  }
  for (std::size_t length : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(path("c"), std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW(read_film(path("c")), InputError) << "length " << length;
  }
  EXPECT_THROW(read_film(path("missing")), InputError);
}

// A header that lies has a right checksum too: what it says is refused by name before it is used, and nothing large is taken for it.
TEST_F(FilmFile, HeadersThatLieAreRefused) {
  constexpr std::size_t kTrailer = 24;
  const std::string bytes = encode_film(record_);
  const auto error_with = [&](std::string body) {
    const std::uint64_t words[2] = {fnv1a(body.data(), body.size()), body.size() + kTrailer};
    body.append(reinterpret_cast<const char*>(words), sizeof words).append(bytes, bytes.size() - 8);
    std::ofstream(path("b"), std::ios::binary) << body;
    try {
      read_film(path("b"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string body = bytes.substr(0, bytes.size() - kTrailer);
  ASSERT_EQ(error_with(body), "");
  const auto header_error = [&](const std::string& key, const std::string& value) {
    const std::size_t at = body.find("\n" + key + " ") + key.size() + 2, end = body.find('\n', at);
    return error_with(body.substr(0, at) + value + body.substr(end));
  };
  const struct { const char *key, *value, *reason; } lies[] = {
      {"width", "0", "'width' is out of range"}, {"width", "-4", "'width' is out of range"}, {"width", "1e9", "'width' is no number"},
      {"width", "99999999999", "'width' is no number"}, {"full_width", "2147483647", "'full_width' is out of range"}, {"height", "nan", "'height' is no number"},
      {"height", "2", "its size does not fit its header"}, {"crop_x", "5", "its window lies outside its image"}, {"crop_y", "-1", "'crop_y' is out of range"},
      {"channels", "4096", "it has unknown channels"}, {"channels", "16", "its channels need others"}, {"channels", "3", "its words do not fit its channels"},
      {"spectral_bins", "2000000000", "'spectral_bins' is out of range"}, {"spectral_bins", "1", "its words do not fit its channels"},
      {"spectral_begin", "500", "its spectral bins are empty"}, {"quantum", "0", "'quantum' is out of range"}, {"quantum", "nan", "'quantum' is out of range"},
      {"depth_quantum", "inf", "'depth_quantum' is out of range"}, {"stride", "0", "'stride' is out of range"}, {"sample_end", "17", "'sample_end' is out of range"},
      {"sample_begin", "10", "'sample_begin' is out of range"}, {"seed", "4294967296", "'seed' is out of range"}, {"seed", "1x", "'seed' is no number"},
      {"rays", "-1", "'rays' is no number"}};
  for (const auto& [key, value, reason] : lies) EXPECT_EQ(header_error(key, value), path("b") + ": is damaged: " + reason) << key << ' ' << value;
  std::string negative = body;
  negative[negative.find("\n\n") + 2 + 8 * 10 + 7] = static_cast<char>(0x80);  // the first pixel's samples
  EXPECT_EQ(error_with(negative), path("b") + ": is damaged: a pixel has fewer samples than none");
}

// A pipe would be waited for, a device read without end.
TEST_F(FilmFile, OnlyRegularFiles) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& name : {path("pipe"), folder_, std::string("/dev/zero")}) {
    EXPECT_FALSE(holds_film(name)) << name;
    EXPECT_THROW(read_film(name), InputError) << name;
  }
}

TEST_F(FilmFile, MismatchesAreNamed) {
  FilmRecord other = record_;
  other.identity.seed = 1;
  EXPECT_NE(film_mismatch(record_, other).find("seed"), std::string::npos);
  other = record_;
  other.identity.scene_hash = "f";
  EXPECT_NE(film_mismatch(record_, other).find("scene"), std::string::npos);
  other = record_;
  other.film.crop_x = 3;
  EXPECT_NE(film_mismatch(record_, other).find("window"), std::string::npos);
}

}  // namespace
}  // namespace stokes
