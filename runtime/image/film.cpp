// Sums of samples as integers and their development into an image. Knows the film's layout, nothing of files or integrators.
#include "image/film.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "layout.h"

namespace stokes {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr double kLargest = 4611686018427387904.0;  // 2^62
constexpr double kUnit = 1.0 / 16777216.0;          // 2^-24: the quantum of alpha, albedo and normals

constexpr int kSquares = 3, kAlpha = 9, kSamples = 10, kInvalid = 11;

/// A value in quanta, rounded to nearest even. False when it is not finite or does not fit.
bool to_quanta(double value, double quantum, std::int64_t& out) {
  const double q = value / quantum;
  if (!(std::fabs(q) <= kLargest)) return false;
  out = static_cast<std::int64_t>(std::nearbyint(q));
  return true;
}

/// Sums wrap as they do on the device, where signed overflow is harmless.
void add(std::int64_t& sum, std::int64_t value) {
  sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) + static_cast<std::uint64_t>(value));
}

Wide wide(const std::int64_t* low_high) {
  return (static_cast<Wide>(static_cast<std::uint64_t>(low_high[1])) << 64) | static_cast<std::uint64_t>(low_high[0]);
}

Wide square(std::int64_t value) {
  const std::uint64_t magnitude = value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  return static_cast<Wide>(magnitude) * magnitude;
}

void add_square(std::int64_t* low_high, std::int64_t value) {
  const Wide sum = wide(low_high) + square(value);
  low_high[0] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum));
  low_high[1] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum >> 64));
}

/// Words of the spectral bins, of all light and, where they are kept, of fluorescent light.
int bin_words(const Film& film) { return film.spectral_bins * (film.channels & FILM_FLUORESCENT_BINS ? 2 : 1); }

/// The quantum of each word after the base words, in the order of layout.h.
std::vector<double> extra_quanta(const Film& film) {
  std::vector<double> quanta;
  if (film.channels & FILM_ALBEDO) quanta.insert(quanta.end(), 3, kUnit);
  if (film.channels & FILM_NORMAL) quanta.insert(quanta.end(), 3, kUnit);
  if (film.channels & FILM_DEPTH) quanta.push_back(film.depth_quantum);
  if (film.channels & FILM_FLUORESCENCE) quanta.insert(quanta.end(), 4, film.quantum);
  quanta.insert(quanta.end(), static_cast<std::size_t>(bin_words(film)), film.quantum);
  return quanta;
}

std::vector<std::string> extra_names(const Film& film) {
  std::vector<std::string> names;
  const auto append = [&](std::initializer_list<const char*> list) { names.insert(names.end(), list.begin(), list.end()); };
  if (film.channels & FILM_ALBEDO) append({"Albedo.R", "Albedo.G", "Albedo.B"});
  if (film.channels & FILM_NORMAL) append({"N.X", "N.Y", "N.Z"});
  if (film.channels & FILM_DEPTH) append({"Z"});
  if (film.channels & FILM_FLUORESCENCE) append({"Fluorescence.R", "Fluorescence.G", "Fluorescence.B", "Fluorescence.Energy"});
  for (int word = 0; word < bin_words(film); word++) {
    const int i = word % film.spectral_bins;
    names.push_back((word < film.spectral_bins ? "" : "Fluorescence.") +
                    spectral_channel_name(film.spectral_begin + (i + 0.5) * (film.spectral_end - film.spectral_begin) / film.spectral_bins));
  }
  return names;
}

std::size_t pixel_count(const Film& film) { return static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height); }

/// One plane of means: word `word` of each pixel times `quantum` over the pixel's samples.
std::vector<float> mean_plane(const Film& film, int word, double quantum) {
  std::vector<float> plane(pixel_count(film));
  for (std::size_t i = 0; i < plane.size(); i++) {
    const std::int64_t* p = &film.words[i * static_cast<std::size_t>(film.stride)];
    plane[i] = p[kSamples] > 0 ? static_cast<float>(static_cast<double>(p[word]) * quantum / static_cast<double>(p[kSamples])) : 0.0f;
  }
  return plane;
}

std::vector<float> variance_plane(const Film& film, int channel) {
  std::vector<float> plane(pixel_count(film));
  for (std::size_t i = 0; i < plane.size(); i++) {
    const int x = static_cast<int>(i) % film.width, y = static_cast<int>(i) / film.width;
    plane[i] = static_cast<float>(film_variance(film, x, y, channel));
  }
  return plane;
}

}  // namespace

const Image::Channel* Image::find(const std::string& name) const {
  for (const Channel& channel : channels)
    if (channel.name == name) return &channel;
  return nullptr;
}

std::string spectral_channel_name(double nm) {
  char text[64];
  std::snprintf(text, sizeof text, "S0.%.6fnm", nm);
  std::string name = text;
  name[name.find('.', 3)] = ',';
  return name;
}

Film make_film(int full_width, int full_height, int crop_x, int crop_y, int width, int height, unsigned channels, int spectral_bins,
               double spectral_begin, double spectral_end, double quantum, double depth_quantum) {
  Film film;
  film.width = width;
  film.height = height;
  film.crop_x = crop_x;
  film.crop_y = crop_y;
  film.full_width = full_width;
  film.full_height = full_height;
  film.channels = channels;
  film.spectral_bins = spectral_bins;
  film.spectral_begin = spectral_begin;
  film.spectral_end = spectral_end;
  film.quantum = quantum;
  film.depth_quantum = depth_quantum;
  film.stride = FILM_BASE_WORDS + static_cast<int>(extra_quanta(film).size());
  film.words.assign(pixel_count(film) * static_cast<std::size_t>(film.stride), 0);
  return film;
}

void film_add(Film& film, int x, int y, const double rgb[3], double alpha, const double* aovs, const double* bins) {
  std::int64_t* pixel = &film.words[(static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x)) *
                                    static_cast<std::size_t>(film.stride)];
  // Everything is converted before anything is added, so that an invalid sample leaves no trace but its count.
  const int aov_count = film.stride - FILM_BASE_WORDS - bin_words(film);
  static thread_local std::vector<std::int64_t> extra;
  extra.assign(static_cast<std::size_t>(film.stride - FILM_BASE_WORDS), 0);
  std::int64_t color[3], coverage = 0;
  bool valid = to_quanta(alpha, kUnit, coverage);
  for (int c = 0; c < 3; c++) valid &= to_quanta(rgb[c], film.quantum, color[c]);
  int word = 0;
  const auto convert = [&](const double*& values, int count, double quantum) {
    for (int i = 0; i < count; i++, word++) valid &= to_quanta(*values++, quantum, extra[static_cast<std::size_t>(word)]);
  };
  if (aovs && aov_count > 0) {
    if (film.channels & FILM_ALBEDO) convert(aovs, 3, kUnit);
    if (film.channels & FILM_NORMAL) convert(aovs, 3, kUnit);
    if (film.channels & FILM_DEPTH) convert(aovs, 1, film.depth_quantum);
    if (film.channels & FILM_FLUORESCENCE) convert(aovs, 4, film.quantum);
  }
  word = aov_count;
  if (bins) convert(bins, bin_words(film), film.quantum);

  if (!valid) {
    pixel[kInvalid]++;
    return;
  }
  for (int c = 0; c < 3; c++) {
    add(pixel[c], color[c]);
    add_square(pixel + kSquares + 2 * c, color[c]);
  }
  add(pixel[kAlpha], coverage);
  pixel[kSamples]++;
  for (std::size_t i = 0; i < extra.size(); i++) add(pixel[FILM_BASE_WORDS + i], extra[i]);
}

double film_mean(const Film& film, int x, int y, int channel) {
  const std::int64_t* p = film_pixel(film, x, y);
  const double quantum = channel < 3 ? film.quantum : kUnit;
  return p[kSamples] > 0 ? static_cast<double>(p[channel < 3 ? channel : kAlpha]) * quantum / static_cast<double>(p[kSamples]) : 0.0;
}

double film_variance(const Film& film, int x, int y, int channel) {
  const std::int64_t* p = film_pixel(film, x, y);
  const std::int64_t n = p[kSamples];
  if (n < 2) return 0;
  // sum (x - mean)^2 = S2 - S1^2 / n, in integers: the subtraction cancels nothing but what is equal.
  const Wide s2 = wide(p + kSquares + 2 * channel), mean_part = square(p[channel]) / static_cast<Wide>(n);
  const double deviations = s2 > mean_part ? static_cast<double>(s2 - mean_part) : 0.0;
  return deviations * film.quantum * film.quantum / (static_cast<double>(n) * static_cast<double>(n - 1));
}

FilmTotals film_totals(const Film& film) {
  FilmTotals totals;
  for (int y = 0; y < film.height; y++)
    for (int x = 0; x < film.width; x++) {
      const std::int64_t* p = film_pixel(film, x, y);
      totals.samples += static_cast<std::uint64_t>(p[kSamples]);
      if (p[kInvalid] == 0) continue;
      if (totals.invalid == 0) {
        totals.first_invalid_x = film.crop_x + x;
        totals.first_invalid_y = film.crop_y + y;
      }
      totals.invalid += static_cast<std::uint64_t>(p[kInvalid]);
    }
  return totals;
}

bool film_same_kind(const Film& a, const Film& b) {
  return a.width == b.width && a.height == b.height && a.crop_x == b.crop_x && a.crop_y == b.crop_y && a.full_width == b.full_width &&
         a.full_height == b.full_height && a.channels == b.channels && a.spectral_bins == b.spectral_bins &&
         a.spectral_begin == b.spectral_begin && a.spectral_end == b.spectral_end && a.quantum == b.quantum &&
         a.depth_quantum == b.depth_quantum && a.stride == b.stride;
}

void film_accumulate(Film& into, const Film& part) {
  for (std::size_t i = 0; i < into.words.size(); i += static_cast<std::size_t>(into.stride))
    for (int w = 0; w < into.stride; w++) {
      std::int64_t* to = &into.words[i];
      const std::int64_t* from = &part.words[i];
      if (w < kSquares || w >= kAlpha) {
        add(to[w], from[w]);
      } else if ((w - kSquares) % 2 == 0) {
        const Wide sum = wide(to + w) + wide(from + w);
        to[w] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum));
        to[w + 1] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum >> 64));
      }
    }
}

std::vector<float> film_plane(const Film& film, const std::string& name) {
  const char* colors[3] = {"R", "G", "B"};
  for (int c = 0; c < 3; c++) {
    if (name == colors[c]) return mean_plane(film, c, film.quantum);
    if (name == std::string("Variance.") + colors[c]) return variance_plane(film, c);
  }
  if (name == "A") return mean_plane(film, kAlpha, kUnit);
  const std::vector<std::string> names = extra_names(film);
  for (std::size_t i = 0; i < names.size(); i++)
    if (name == names[i]) return mean_plane(film, FILM_BASE_WORDS + static_cast<int>(i), extra_quanta(film)[i]);
  throw std::invalid_argument("the film has no channel " + name);
}

std::vector<double> film_bins(const Film& film, int x, int y, bool fluorescent) {
  const std::int64_t* words = film_pixel(film, x, y);
  const int first = film.stride - bin_words(film) + (fluorescent ? film.spectral_bins : 0);
  std::vector<double> bins(static_cast<std::size_t>(film.spectral_bins), 0.0);
  for (std::size_t i = 0; i < bins.size() && words[kSamples] > 0; i++)
    bins[i] = static_cast<double>(words[first + static_cast<int>(i)]) * film.quantum / static_cast<double>(words[kSamples]);
  return bins;
}

Image develop(const Film& film, bool variance) {
  Image image;
  image.width = film.width;
  image.height = film.height;
  image.x = film.crop_x;
  image.y = film.crop_y;
  image.full_width = film.full_width;
  image.full_height = film.full_height;
  const char* names[3] = {"R", "G", "B"};
  for (int c = 0; c < 3; c++) image.channels.push_back({names[c], mean_plane(film, c, film.quantum)});
  image.channels.push_back({"A", mean_plane(film, kAlpha, kUnit)});
  if (variance)
    for (int c = 0; c < 3; c++) image.channels.push_back({std::string("Variance.") + names[c], variance_plane(film, c)});
  const std::vector<double> quanta = extra_quanta(film);
  const std::vector<std::string> extra = extra_names(film);
  for (std::size_t i = 0; i < quanta.size(); i++)
    image.channels.push_back({extra[i], mean_plane(film, FILM_BASE_WORDS + static_cast<int>(i), quanta[i])});
  if (film.spectral_bins > 0) {
    image.metadata.emplace_back("spectralLayoutVersion", "1.0");
    image.metadata.emplace_back("emissiveUnits", "W.m^-2.sr^-1");
  }
  return image;
}

}  // namespace stokes
