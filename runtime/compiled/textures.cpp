// Colour slots and textures: references, transforms, masks. The pixels of images are in texels.cpp.
#include <algorithm>
#include <cmath>

#include "compiled/compilation.h"
#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

std::uint32_t append_spectrum(Compilation& c, const Spectrum& s, SpectrumRole role) {
  Curve curve = c.spectra.curve(s, role);
  // Measured curves may dip below zero by noise; more than that is a mistake. (RGB mode: saturated emissions leave the gamut.)
  double peak = 0, low = 0;
  for (double v : curve) peak = std::max(peak, v), low = std::min(low, v);
  if (low < -1e-3 * peak && !c.spectra.rgb())
    for (std::size_t i = 0; i < curve.size(); i++)
      if (curve[i] == low) c.fail(s.pointer, "negative value " + std::to_string(low) + " at " + c.spectra.place(i));
  for (double& v : curve) v = std::max(v, 0.0);
  return c.spectra.add(curve);
}

// A leaf of a scalar texture: one number, wherever it is read.
std::uint32_t append_scalar(Compilation& c, const Spectrum& s) {
  const Curve curve = c.spectra.curve(s, SpectrumRole::Coefficient);
  return c.spectra.add(c.spectra.constant(c.spectra.integral(curve) / (kLambdaMax - kLambdaMin)));
}

SpectrumRole role_of(TextureUse use) { return use == TextureUse::Emission ? SpectrumRole::Emission : SpectrumRole::Reflectance; }

std::uint32_t compile_leaf(Compilation& c, const ColorSource& leaf, TextureUse use, double fallback) {
  if (leaf.texture) return compile_texture(c, *leaf.texture, use) | STOKES_TEXTURE_BIT;
  if (!leaf.spectrum) return c.spectra.add(c.spectra.constant(fallback));
  if (use == TextureUse::Scalar) return append_scalar(c, *leaf.spectrum);
  return append_spectrum(c, *leaf.spectrum, role_of(use));
}

// What two-colour textures need: leaves, and half of each as the mean.
void fill_two_colors(Compilation& c, const TextureDescription& t, TextureUse use, layout::Texture& out, Curve& mean, Curve& peak) {
  if (t.kind == TextureKind::Marble && (t.a.texture || t.b.texture)) c.fail(t.pointer, "marble mixes two spectra, not textures");
  out.a = compile_leaf(c, t.a, use, use == TextureUse::Emission ? 0 : 1);
  out.b = compile_leaf(c, t.b, use, 0);
  const Curve ma = mean_curve(c, out.a), mb = mean_curve(c, out.b), pa = peak_curve(c, out.a), pb = peak_curve(c, out.b);
  for (std::size_t i = 0; i < mean.size(); i++) mean[i] = (ma[i] + mb[i]) / 2, peak[i] = std::max(pa[i], pb[i]);
}

void fill_image(Compilation& c, const TextureDescription& t, TextureUse use, layout::Texture& out, Curve& mean, Curve& peak) {
  if (!t.image || t.image->width <= 0 || t.image->height <= 0) c.fail(t.pointer, "the image has no pixels");
  const Texels texels = append_texels(c, *t.image, use);
  out.image_offset = texels.offset;
  out.image_width = std::uint32_t(t.image->width);
  out.image_height = std::uint32_t(t.image->height);
  if (t.clamp) out.flags |= TEXTURE_WRAP_CLAMP;
  if (t.nearest) out.flags |= TEXTURE_NEAREST;
  if (use == TextureUse::Scalar) {
    out.flags |= TEXTURE_SCALAR_IMAGE;
    return;
  }
  Spectrum color;
  color.kind = SpectrumKind::Rgb;
  color.rgb = texels.mean;
  mean = c.spectra.curve(color, role_of(use));
  std::fill(peak.begin(), peak.end(), std::max({texels.peak.x, texels.peak.y, texels.peak.z}));
  if (use == TextureUse::Emission) {
    Spectrum white;
    white.value = 1;
    out.b = c.spectra.add(white, SpectrumRole::Emission);
    const Curve d65 = c.spectra.read(out.b);
    for (std::size_t i = 0; i < peak.size(); i++) peak[i] *= d65[i];
  }
}

void fill_region(Compilation& c, const TextureDescription& t, layout::Texture& out) {
  out.first_shape = std::uint32_t(c.out.regions.size());
  out.shape_count = std::uint32_t(t.shapes.size());
  for (const RegionShapeDescription& s : t.shapes) {
    layout::Region r{};
    r.a = to_float(s.a);
    r.b = to_float(s.b);
    r.radius = float(s.radius);
    switch (s.kind) {
      case RegionShapeDescription::Kind::Sphere: r.shape = layout::REGION_SPHERE; break;
      case RegionShapeDescription::Kind::Box:
        r.shape = layout::REGION_BOX;
        r.a = to_float(min(s.a, s.b));
        r.b = to_float(max(s.a, s.b));
        break;
      case RegionShapeDescription::Kind::Capsule: r.shape = layout::REGION_CAPSULE; break;
    }
    c.out.regions.push_back(r);
  }
}

layout::uint texture_type(TextureKind kind) {
  switch (kind) {
    case TextureKind::Checker: return layout::TEXTURE_CHECKER;
    case TextureKind::Marble: return layout::TEXTURE_MARBLE;
    case TextureKind::Image: return layout::TEXTURE_IMAGE;
    case TextureKind::Wireframe: return layout::TEXTURE_WIREFRAME;
    case TextureKind::Fresnel: return layout::TEXTURE_FRESNEL;
    case TextureKind::Region: return layout::TEXTURE_REGION;
    case TextureKind::VertexMask: return layout::TEXTURE_VERTEX_MASK;
  }
  return layout::TEXTURE_CHECKER;
}

}  // namespace

std::uint32_t compile_color(Compilation& c, const ColorSource& source, SpectrumRole role, double fallback) {
  if (source.texture)
    return compile_texture(c, *source.texture, role == SpectrumRole::Emission ? TextureUse::Emission : TextureUse::Reflectance) |
           STOKES_TEXTURE_BIT;
  if (!source.spectrum) return c.spectra.add(c.spectra.constant(fallback));
  return append_spectrum(c, *source.spectrum, role);
}

std::uint32_t compile_texture(Compilation& c, const TextureDescription& t, TextureUse use) {
  const auto key = std::make_pair(&t, use);
  if (const auto known = c.textures.find(key); known != c.textures.end()) return known->second;

  layout::Texture out{};
  out.type = texture_type(t.kind);
  out.a = out.b = STOKES_NONE;
  out.scale = float(t.scale);
  out.parameter = float(t.parameter);
  if (!(std::abs(t.transform.determinant()) > 0)) c.fail(t.pointer, "the texture's transform must be invertible");
  const Affine to_texture = t.transform.inverse();
  for (int i = 0; i < 12; i++) out.to_texture[i] = float(to_texture.m[i]);

  Curve mean = c.spectra.constant(0.5), peak = c.spectra.constant(1);
  bool mask = false;
  switch (t.kind) {
    case TextureKind::Checker:
    case TextureKind::Marble:
    case TextureKind::Wireframe: fill_two_colors(c, t, use, out, mean, peak); break;
    case TextureKind::Image: fill_image(c, t, use, out, mean, peak); break;
    case TextureKind::Region: fill_region(c, t, out), mask = true; break;
    case TextureKind::Fresnel:
    case TextureKind::VertexMask: mask = true; break;
  }
  if (mask && use != TextureUse::Scalar) c.fail(t.pointer, "this texture is a number, not a colour: it may stand as an amount or a mask");
  if (t.kind == TextureKind::Checker && !(std::abs(t.scale) > 0)) c.fail(t.pointer, "a checker's scale must not be 0");

  const auto index = std::uint32_t(c.out.textures.size());
  c.out.textures.push_back(out);
  c.textures.emplace(key, index);
  c.mean_curves[index] = std::move(mean);
  c.peak_curves[index] = std::move(peak);
  if (t.kind == TextureKind::VertexMask) c.masks.push_back({index, t.mask_name, t.pointer});
  c.out.features.textures = true;
  if (use == TextureUse::Emission) c.out.features.emission_textures = true;
  return index;
}

Curve mean_curve(const Compilation& c, std::uint32_t reference) {
  return reference & STOKES_TEXTURE_BIT ? c.mean_curves.at(reference & ~STOKES_TEXTURE_BIT) : c.spectra.read(reference);
}

Curve peak_curve(const Compilation& c, std::uint32_t reference) {
  return reference & STOKES_TEXTURE_BIT ? c.peak_curves.at(reference & ~STOKES_TEXTURE_BIT) : c.spectra.read(reference);
}

void append_vertex_masks(Compilation& c) {
  for (const PendingMask& mask : c.masks) {
    const std::size_t offset = c.out.texels.size();
    c.out.texels.resize(offset + c.out.positions.size(), 0.0f);
    bool found = false;
    for (const MeshRange& range : c.meshes)
      for (const auto& [name, values] : range.mesh->masks) {
        if (name != mask.mask_name || values.size() != range.mesh->positions.size()) continue;
        found = true;
        for (std::size_t i = 0; i < range.source.size(); i++) c.out.texels[offset + range.first_vertex + i] = values[range.source[i]];
      }
    if (!found) c.fail(mask.pointer, "no mesh of the scene has a mask named '" + mask.mask_name + "'");
    c.out.textures[mask.texture].image_offset = std::uint32_t(offset);
    c.out.textures[mask.texture].image_width = std::uint32_t(c.out.positions.size());
  }
}

}  // namespace stokes::compiled
