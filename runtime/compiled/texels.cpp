// Pixels of images as texels: coefficients of upsampled spectra, or single numbers for masks.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "compiled/compilation.h"
#include "compiled/upsampling_grid.h"

namespace stokes::compiled {
namespace {

// Images with more colours than this interpolate their upsampled spectra (a fit takes 10 us).
constexpr std::size_t kExactColors = 20000;

struct Texel {
  float c0, c1, c2, scale;
};

// A pixel's three floats as a key.
struct ColorKey {
  std::uint32_t r, g, b;
  bool operator==(const ColorKey&) const = default;
};
struct ColorHash {
  std::size_t operator()(const ColorKey& k) const {
    return std::size_t(((std::uint64_t(k.r) << 32 | k.g) * 0x9e3779b97f4a7c15u ^ k.b) * 0xd6e8feb86659fd93u >> 7);
  }
};

ColorKey key_of(const float* rgb) {
  ColorKey k;
  std::memcpy(&k, rgb, sizeof k);
  return k;
}

bool has_many_colors(const ImagePixels& image, std::size_t pixels) {
  std::unordered_set<ColorKey, ColorHash> colors;
  for (std::size_t i = 0; i < pixels && colors.size() <= kExactColors; i++) colors.insert(key_of(&image.rgb[3 * i]));
  return colors.size() > kExactColors;
}

// Turns colours into texels, each colour once.
class Upsampler {
 public:
  Upsampler(TextureUse use, bool rgb_mode, bool many_colors) : use_(use), rgb_mode_(rgb_mode), many_colors_(many_colors) {}

  Texel texel(const float* pixel, Vec3d rgb) {
    if (rgb_mode_) return {float(rgb.x), float(rgb.y), float(rgb.z), 0};
    if (many_colors_) return upsample(rgb);
    const auto [place, fresh] = known_.try_emplace(key_of(pixel));
    if (fresh) place->second = upsample(rgb);
    return place->second;
  }

 private:
  // Emissions are normalised to half the largest channel, where the sigmoid is smooth and a grey is exactly constant; reflectances
  // keep their values, so that they stay below 1.
  Texel upsample(Vec3d rgb) {
    const double peak = std::max({rgb.x, rgb.y, rgb.z});
    if (!(peak > 0)) return {0, 0, 0, 0};
    double scale = 1;
    if (use_ == TextureUse::Emission) scale = 2 * peak;
    else if (many_colors_) scale = std::min(1.0, peak / UpsamplingGrid::kDarkest);
    const auto c = many_colors_ ? grid_.coefficients(rgb / scale) : fit_sigmoid(rgb / scale);
    return {c[0], c[1], c[2], float(scale)};
  }

  TextureUse use_;
  bool rgb_mode_, many_colors_;
  UpsamplingGrid grid_;
  std::unordered_map<ColorKey, Texel, ColorHash> known_;
};

}  // namespace

Texels append_texels(Compilation& c, const ImagePixels& image, TextureUse use) {
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  std::vector<float>& out = c.out.texels;
  Texels result{std::uint32_t(out.size()), {}, {}};
  out.reserve(out.size() + pixels * (use == TextureUse::Scalar ? 1 : 4));
  const bool fitted = use != TextureUse::Scalar && !c.spectra.rgb();
  Upsampler upsampler(use, c.spectra.rgb(), fitted && has_many_colors(image, pixels));
  const double limit = use == TextureUse::Reflectance ? 1 : std::numeric_limits<double>::infinity();

  for (std::size_t i = 0; i < pixels; i++) {
    const float* p = &image.rgb[3 * i];
    const auto channel = [&](int k) { return std::isfinite(p[k]) ? std::clamp(double(p[k]), 0.0, limit) : 0.0; };
    const Vec3d rgb = {channel(0), channel(1), channel(2)};
    result.mean += rgb;
    result.peak = max(result.peak, rgb);
    if (use == TextureUse::Scalar) {
      out.push_back(float((rgb.x + rgb.y + rgb.z) / 3));
    } else {
      const Texel texel = upsampler.texel(p, rgb);
      out.insert(out.end(), {texel.c0, texel.c1, texel.c2, texel.scale});
    }
  }
  result.mean = result.mean / double(pixels);
  return result;
}

}  // namespace stokes::compiled
