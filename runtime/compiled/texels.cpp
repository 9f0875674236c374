// Pixels of images as texels: coefficients of upsampled spectra, or single numbers for masks.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

struct Texel {
  float c0, c1, c2, scale;
};

// Emissions are normalised to half the largest channel, where the sigmoid is smooth and a grey is exactly constant; reflectances keep
// their values, so that they stay below 1.
Texel upsample(Vec3d rgb, TextureUse use) {
  const double peak = std::max({rgb.x, rgb.y, rgb.z});
  const bool emission = use == TextureUse::Emission;
  const double scale = emission ? 2 * peak : 1;
  if (!(peak > 0) && emission) return {0, 0, 0, 0};
  const auto c = fit_sigmoid(emission ? rgb / scale : rgb);
  return {c[0], c[1], c[2], float(scale)};
}

// The colour's three floats as a key.
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

}  // namespace

Texels append_texels(Compilation& c, const ImagePixels& image, TextureUse use) {
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  std::vector<float>& out = c.out.texels;
  Texels result{std::uint32_t(out.size()), {}, {}};
  out.reserve(out.size() + pixels * (use == TextureUse::Scalar ? 1 : 4));
  std::unordered_map<ColorKey, Texel, ColorHash> known;

  for (std::size_t i = 0; i < pixels; i++) {
    const float* p = &image.rgb[3 * i];
    const auto channel = [&](int k) { return std::isfinite(p[k]) ? std::max(double(p[k]), 0.0) : 0.0; };
    const Vec3d rgb = {channel(0), channel(1), channel(2)};
    result.mean += rgb;
    result.peak = max(result.peak, rgb);
    if (use == TextureUse::Scalar) {
      out.push_back(float((rgb.x + rgb.y + rgb.z) / 3));
      continue;
    }
    Texel texel{float(rgb.x), float(rgb.y), float(rgb.z), 0};
    if (!c.spectra.rgb()) {
      const auto [place, fresh] = known.try_emplace(key_of(p));
      if (fresh) place->second = upsample(rgb, use);
      texel = place->second;
    }
    out.insert(out.end(), {texel.c0, texel.c1, texel.c2, texel.scale});
  }
  result.mean = result.mean / double(pixels);
  return result;
}

}  // namespace stokes::compiled
