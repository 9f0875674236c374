// The film: per-pixel sums of samples as integers, so that neither the order of samples nor the split into parts changes a bit.
// Both integrators fill one; `develop` turns it into an image.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace stokes {

/// Sums over samples; the words of a pixel are laid out as layout.h says (FILM_BASE_WORDS and the channels after it).
struct Film {
  int width = 0, height = 0;            ///< of the window that is rendered
  int crop_x = 0, crop_y = 0;           ///< the window's place in the full image
  int full_width = 0, full_height = 0;
  unsigned channels = 0;                ///< FILM_*
  int spectral_bins = 0;
  double spectral_begin = 0, spectral_end = 0;
  double quantum = 1, depth_quantum = 1;
  int stride = 0;                       ///< words per pixel
  std::vector<std::int64_t> words;      ///< height * width * stride
};

/// Named float planes, row 0 at the top. Channel names are the EXR's ("R", "Albedo.R", "Variance.R", "S0.550,000000nm").
struct Image {
  int width = 0, height = 0;
  struct Channel {
    std::string name;
    std::vector<float> values;  ///< height * width
  };
  int x = 0, y = 0;                    ///< the window's place in the full image
  int full_width = 0, full_height = 0; ///< 0: the window is the whole image
  std::vector<Channel> channels;
  std::vector<std::pair<std::string, std::string>> metadata;
  const Channel* find(const std::string& name) const;
};

/// An empty film for a scene's window.
Film make_film(int full_width, int full_height, int crop_x, int crop_y, int width, int height, unsigned channels, int spectral_bins,
               double spectral_begin, double spectral_end, double quantum, double depth_quantum);

/// Adds one sample of one pixel (the reference's way in; the kernels do the same on the device). rgb in film radiance; aovs and bins
/// (with FILM_FLUORESCENT_BINS twice as many) follow the order of layout.h and may be null where not used. A sample that is not finite, or too large for the film, is counted
/// as invalid and left out.
void film_add(Film& film, int x, int y, const double rgb[3], double alpha, const double* aovs, const double* bins);

/// The words of a pixel of the window.
inline const std::int64_t* film_pixel(const Film& film, int x, int y) {
  return &film.words[(static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x)) *
                     static_cast<std::size_t>(film.stride)];
}

/// A pixel's mean: channel 0, 1, 2 for R, G, B, 3 for alpha. 0 without samples.
double film_mean(const Film& film, int x, int y, int channel);
/// The variance of that mean (channels 0, 1, 2), from the samples' own spread; 0 with fewer than two samples.
double film_variance(const Film& film, int x, int y, int channel);

/// Valid and invalid samples of all pixels, and the first pixel (row by row, in the full image) that had an invalid one.
struct FilmTotals {
  std::uint64_t samples = 0, invalid = 0;
  int first_invalid_x = -1, first_invalid_y = -1;
};
FilmTotals film_totals(const Film& film);

/// True when the sums of one may be added to the other's: same window, words and quanta.
bool film_same_kind(const Film& a, const Film& b);
/// Adds the sums of `part`, of the same kind, exactly: merged parts have the bits of one render.
void film_accumulate(Film& into, const Film& part);

/// The name of a spectral channel in the layout of Fichet et al. 2021: "S0.550,000000nm".
std::string spectral_channel_name(double nm);

/// One channel of `develop` by its name, without the rest. Throws std::invalid_argument for a name that the film does not have.
std::vector<float> film_plane(const Film& film, const std::string& name);
/// The mean radiance per nm of a pixel in each spectral bin, of all light or of the fluorescent part (FILM_FLUORESCENT_BINS).
std::vector<double> film_bins(const Film& film, int x, int y, bool fluorescent);

/// Means, and with `variance` the variance of each pixel's mean (Variance.R, .G, .B).
Image develop(const Film& film, bool variance);

}  // namespace stokes
