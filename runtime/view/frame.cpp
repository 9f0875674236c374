// A film as a page shows it. See frame.h.
#include "view/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "layout.h"

namespace stokes {
namespace {

using Planes = std::vector<std::vector<float>>;

Planes read_planes(const Film& film, std::initializer_list<const char*> names) {
  Planes planes;
  for (const char* name : names) planes.push_back(film_plane(film, name));
  return planes;
}

Planes layer_planes(const Film& film, const std::string& layer) {
  if (layer == "picture") return read_planes(film, {"R", "G", "B"});
  if (layer == "albedo") return read_planes(film, {"Albedo.R", "Albedo.G", "Albedo.B"});
  if (layer == "normal") return read_planes(film, {"N.X", "N.Y", "N.Z"});
  if (layer == "depth") return read_planes(film, {"Z"});
  if (layer == "fluorescence") return read_planes(film, {"Fluorescence.R", "Fluorescence.G", "Fluorescence.B"});
  if (layer == "noise") {
    Planes planes = read_planes(film, {"Variance.R", "Variance.G", "Variance.B"});
    for (auto& plane : planes)
      for (float& v : plane) v = std::sqrt(v);
    return planes;
  }
  if (layer == "reflected") {
    Planes planes = read_planes(film, {"R", "G", "B"});
    const Planes excited = layer_planes(film, "fluorescence");
    for (std::size_t c = 0; c < 3; c++)
      for (std::size_t i = 0; i < planes[c].size(); i++) planes[c][i] -= excited[c][i];
    return planes;
  }
  throw std::invalid_argument("there is no layer " + layer);
}

void append_word(std::string& bytes, std::uint32_t word) {
  static_assert(std::endian::native == std::endian::little, "words are sent as they lie in memory");
  char raw[sizeof word];
  std::memcpy(raw, &word, sizeof word);
  bytes.append(raw, sizeof word);
}

}  // namespace

std::vector<std::string> frame_layers(unsigned film_channels) {
  std::vector<std::string> layers = {"picture"};
  if (film_channels & FILM_FLUORESCENCE) layers.insert(layers.end(), {"fluorescence", "reflected"});
  if (film_channels & FILM_ALBEDO) layers.push_back("albedo");
  if (film_channels & FILM_NORMAL) layers.push_back("normal");
  if (film_channels & FILM_DEPTH) layers.push_back("depth");
  layers.push_back("noise");
  return layers;
}

std::uint16_t half_of(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);   // NaN
  if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // rounds beyond 65504
  if (magnitude < 0x38800000u) {
    // Below 2^-14 a half counts in steps of 2^-24; rounding to them is rounding to an integer.
    const float steps = std::bit_cast<float>(magnitude) * 16777216.0f;
    return static_cast<std::uint16_t>(sign | static_cast<std::uint16_t>(std::nearbyint(steps)));
  }
  const std::uint32_t rounded = magnitude + 0xfffu + ((magnitude >> 13) & 1u);
  return static_cast<std::uint16_t>(sign | ((rounded - 0x38000000u) >> 13));
}

int frame_exponent(const Planes& planes) {
  float largest = 0;
  for (const auto& plane : planes)
    for (const float v : plane)
      if (std::isfinite(v)) largest = std::max(largest, std::fabs(v));
  return largest > 0 ? std::ilogb(largest) - 13 : 0;
}

std::string encode_frame(const Film& film, const std::string& layer, int samples, std::uint32_t number) {
  return encode_planes(layer_planes(film, layer), film.width, film.height, samples, number);
}

std::string encode_planes(const Planes& planes, int width, int height, int samples, std::uint32_t number) {
  const int exponent = frame_exponent(planes);
  std::string bytes = "STKF";
  for (const std::uint32_t word : {std::uint32_t{1}, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                   static_cast<std::uint32_t>(planes.size()), static_cast<std::uint32_t>(exponent),
                                   static_cast<std::uint32_t>(samples), number})
    append_word(bytes, word);
  const float scale = std::ldexp(1.0f, -exponent);
  std::vector<std::uint16_t> halves(planes.size() * planes[0].size());
  for (std::size_t c = 0; c < planes.size(); c++)
    for (std::size_t i = 0; i < planes[c].size(); i++) halves[i * planes.size() + c] = half_of(planes[c][i] * scale);
  bytes.append(reinterpret_cast<const char*>(halves.data()), halves.size() * sizeof halves[0]);
  return bytes;
}

Probe probe_film(const Film& film, int x, int y, int radius) {
  Probe probe;
  probe.begin = film.spectral_begin;
  probe.end = film.spectral_end;
  const int x0 = std::max(0, x - radius), x1 = std::min(film.width, x + radius + 1), y0 = std::max(0, y - radius), y1 = std::min(film.height, y + radius + 1);
  const double share = 1.0 / ((x1 - x0) * (y1 - y0));
  const auto add = [&](std::vector<double>& sum, const std::vector<double>& bins) {
    sum.resize(bins.size());
    for (std::size_t i = 0; i < bins.size(); i++) sum[i] += share * bins[i];
  };
  for (int py = y0; py < y1; py++) {
    for (int px = x0; px < x1; px++) {
      for (int c = 0; c < 3; c++) {
        probe.rgb[c] += share * film_mean(film, px, py, c);
        probe.error[c] += share * share * film_variance(film, px, py, c);  // pixels are independent
      }
      probe.alpha += share * film_mean(film, px, py, 3);
      add(probe.spectrum, film_bins(film, px, py, false));
      if (film.channels & FILM_FLUORESCENT_BINS) add(probe.fluorescent, film_bins(film, px, py, true));
    }
  }
  for (double& error : probe.error) error = std::sqrt(error);
  probe.samples = film_pixel(film, x, y)[10];
  const double width = film.spectral_bins > 0 ? (film.spectral_end - film.spectral_begin) / film.spectral_bins : 0;
  probe.energy = width * std::accumulate(probe.spectrum.begin(), probe.spectrum.end(), 0.0);
  probe.fluorescent_energy = width * std::accumulate(probe.fluorescent.begin(), probe.fluorescent.end(), 0.0);
  return probe;
}

}  // namespace stokes
