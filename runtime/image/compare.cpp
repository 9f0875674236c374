// How much two images differ: squared errors and a perceptual difference. Knows images only.
#include "image/compare.h"

#include <cmath>

#include "image/error.h"
#include "image/flip.h"

namespace stokes {
namespace {

bool same_value(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool identical_channels(const Image& a, const Image& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (const Image::Channel& channel : a.channels) {
    const Image::Channel* other = b.find(channel.name);
    if (!other) return false;
    for (std::size_t i = 0; i < channel.values.size(); i++)
      if (!same_value(channel.values[i], other->values[i])) return false;
  }
  return true;
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError("the images have different sizes: " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
                     std::to_string(b.width) + "x" + std::to_string(b.height));
  ImageDifference d;
  d.identical = identical_channels(a, b);
  const char* names[3] = {"R", "G", "B"};
  std::size_t counted[3] = {};
  double sums_a[3] = {}, sums_b[3] = {};
  for (int c = 0; c < 3; c++) {
    const Image::Channel *pa = a.find(names[c]), *pb = b.find(names[c]);
    if (!pa || !pb) throw InputError(std::string("an image has no channel ") + names[c]);
    for (std::size_t i = 0; i < pa->values.size(); i++) {
      const double va = static_cast<double>(pa->values[i]), vb = static_cast<double>(pb->values[i]);
      if (!std::isfinite(va) || !std::isfinite(vb)) {
        d.not_finite++;
        continue;
      }
      const double difference = va - vb;
      d.mse += difference * difference;
      d.relative_mse += difference * difference / (vb * vb + 0.01);
      if (std::fabs(difference) > d.largest) {
        d.largest = std::fabs(difference);
        d.largest_x = static_cast<int>(i) % a.width;
        d.largest_y = static_cast<int>(i) / a.width;
      }
      sums_a[c] += va;
      sums_b[c] += vb;
      counted[c]++;
    }
  }
  const double values = std::max<double>(1.0, static_cast<double>(counted[0] + counted[1] + counted[2]));
  d.mse /= values;
  d.relative_mse /= values;
  for (int c = 0; c < 3; c++) {
    const double pixels = std::max<double>(1.0, static_cast<double>(counted[c]));
    d.mean_a[c] = sums_a[c] / pixels;
    d.mean_b[c] = sums_b[c] / pixels;
  }
  d.flip = flip_difference(a, b);
  return d;
}

}  // namespace stokes
