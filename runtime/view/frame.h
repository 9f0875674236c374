// A film as a page shows it: planes of half floats, and one pixel's numbers. Knows films, no protocol and no tone curve.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "image/film.h"

namespace stokes {

/// The layers that a page can show of films with these channels ("picture", "albedo", "normal", "depth", "noise", "fluorescence",
/// "reflected").
std::vector<std::string> frame_layers(unsigned film_channels);

/// One layer as bytes, little-endian: "STKF", then 32-bit words: version 1, width, height, channels (1 or 3), exponent, samples per
/// pixel, number; then height * width * channels half floats, interleaved, row 0 at the top. A half times 2^exponent is the value.
/// `number` tells frames apart. Throws std::invalid_argument for a layer that the film does not have.
std::string encode_frame(const Film& film, const std::string& layer, int samples, std::uint32_t number);

/// Any planes of one size as such bytes, with as many channels as there are planes.
std::string encode_planes(const std::vector<std::vector<float>>& planes, int width, int height, int samples, std::uint32_t number);

/// IEEE 754 half precision, rounded to nearest even; what is too large is infinite.
std::uint16_t half_of(float value);
/// The exponent that brings the largest finite magnitude into [2^13, 2^14), so that halves have all their precision.
int frame_exponent(const std::vector<std::vector<float>>& planes);

struct Probe {
  double rgb[3] = {}, error[3] = {};  ///< mean, and its standard error
  double alpha = 0;
  std::int64_t samples = 0;
  double begin = 0, end = 0;            ///< nm, of the bins
  std::vector<double> spectrum;         ///< mean radiance per nm in each bin; empty without bins
  std::vector<double> fluorescent;      ///< the part of it that was excited; empty where the film does not keep it
  double energy = 0, fluorescent_energy = 0;  ///< over all bins; the second 0 where not kept
};

/// What the film holds of pixel (x, y) of its window, or the mean over the square of pixels up to `radius` beside it, as far as there are any.
Probe probe_film(const Film& film, int x, int y, int radius = 0);

}  // namespace stokes
