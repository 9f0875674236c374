// See bispectral_exr.h.
#include "scene/bispectral_exr.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <regex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "input/open_image.h"

namespace stokes {
namespace {

constexpr std::size_t kMaxValues = std::size_t(1) << 26;
constexpr std::size_t kMaxSide = 1 << 20;  // of either, so that products stay in range

double parse_nanometres(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  return std::stod(text);
}

/// The incoming and the outgoing wavelength that a channel stands for. Early files of the layout say M00 for T.
std::optional<std::pair<double, double>> channel_bands(const std::string& name) {
  static const std::regex pattern(R"((?:T|M00)\.(\d+(?:,\d+)?(?:[Ee][+-]?\d+)?)nm(?:\.(\d+(?:,\d+)?(?:[Ee][+-]?\d+)?)nm)?)");
  std::smatch match;
  if (!std::regex_match(name, match, pattern)) return std::nullopt;
  const double in = parse_nanometres(match[1]);
  return std::pair(in, match[2].matched ? parse_nanometres(match[2]) : in);
}

void sort_unique(std::vector<double>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

std::size_t index_of(const std::vector<double>& bands, double band) {
  return static_cast<std::size_t>(std::lower_bound(bands.begin(), bands.end(), band) - bands.begin());
}

/// Each channel's mean over all pixels.
std::vector<double> read_means(ImageReader& input) {
  const ImageHeader& header = input.header();
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height), channels = header.channels.size();
  if (width > kMaxSide || height > kMaxSide || channels > kMaxSide || width * height * channels > kMaxValues) throw std::runtime_error("the image is too large");
  std::vector<float> pixels(width * height * channels);
  input.read(static_cast<int>(channels), pixels.data());
  std::vector<double> means(channels, 0.0);
  for (std::size_t i = 0; i < pixels.size(); i++) means[i % channels] += pixels[i];
  for (double& m : means) m /= static_cast<double>(pixels.size() / channels);
  return means;
}

}  // namespace

ReradiationMatrix read_bispectral_exr(const std::string& path) {
  const auto input = open_image(path);
  const std::vector<std::string>& names = input->header().channels;

  ReradiationMatrix matrix;
  matrix.filename = path;
  std::vector<std::pair<std::size_t, std::pair<double, double>>> channels;
  for (std::size_t i = 0; i < names.size(); i++)
    if (const auto bands = channel_bands(names[i])) {
      channels.emplace_back(i, *bands);
      matrix.li.push_back(bands->first);
      matrix.lo.push_back(bands->second);
    }
  if (channels.empty()) throw std::runtime_error("there are no channels called T.<nm>nm or T.<in>nm.<out>nm");
  sort_unique(matrix.li);
  sort_unique(matrix.lo);
  if (matrix.li.size() * matrix.lo.size() > kMaxValues) throw std::runtime_error("there are too many bands");

  const std::vector<double> means = read_means(*input);
  matrix.values.assign(matrix.li.size() * matrix.lo.size(), 0.0);
  for (const auto& [channel, bands] : channels) {
    if (!std::isfinite(means[channel])) throw std::runtime_error("the channel " + names[channel] + " is not finite");
    matrix.values[index_of(matrix.lo, bands.second) * matrix.li.size() + index_of(matrix.li, bands.first)] = means[channel];
  }
  return matrix;
}

}  // namespace stokes
