// Checker, marble, image, wireframe, fresnel, region and vertex mask. See texture.h.
#include "reference/texture.h"

#include <cmath>

#include "reference/fresnel.h"
#include "reference/sampling.h"

namespace stokes::reference {
namespace {

using layout::Texture;

Vec3d to_texture(const Texture& t, Vec3d p) {
  const float* m = t.to_texture;
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

bool is_odd(const Texture& t, Vec3d world) {
  const Vec3d p = to_texture(t, world);
  // A plane on a boundary between cells (a floor at y = 0) would flicker with the rounding of its points: it belongs to the cell above.
  auto factor = [](double x) { return std::abs(std::sin(x)) < 1e-4 ? 1.0 : std::sin(x); };
  return factor(p.x / t.scale) * factor(p.y / t.scale) * factor(p.z / t.scale) < 0;
}

/// The weight of marble's base colour; the rest is veins.
double marble_base(const Texture& t, Vec3d world) {
  const Vec3d p = to_texture(t, world);
  return 0.5 * (1 + std::sin(t.scale * p.z + 10 * turbulence(p)));
}

std::size_t wrap(std::int64_t i, std::uint32_t size, bool clamp) {
  const auto n = std::int64_t(size);
  if (clamp) return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, n - 1));
  return static_cast<std::size_t>(((i % n) + n) % n);
}

double image_texel(const CompiledScene& scene, const Texture& t, std::int64_t column, std::int64_t row, Wavelength w) {
  const bool clamp = t.flags & TEXTURE_WRAP_CLAMP;
  const std::size_t i = wrap(row, t.image_height, clamp) * t.image_width + wrap(column, t.image_width, clamp);
  if (t.flags & TEXTURE_SCALAR_IMAGE) return scene.texels[t.image_offset + i];
  return texel_eval(&scene.texels[t.image_offset + 4 * i], w);
}

double image_eval(const CompiledScene& scene, const Texture& t, double u, double v, Wavelength w) {
  // v points up, rows go down.
  const double x = u * t.image_width, y = (1 - v) * t.image_height;
  if (t.flags & TEXTURE_NEAREST) return image_texel(scene, t, std::int64_t(std::floor(x)), std::int64_t(std::floor(y)), w);
  // Texel centres lie at halves.
  const double x0 = std::floor(x - 0.5), y0 = std::floor(y - 0.5), fx = x - 0.5 - x0, fy = y - 0.5 - y0;
  const auto column = std::int64_t(x0), row = std::int64_t(y0);
  const double top = (1 - fx) * image_texel(scene, t, column, row, w) + fx * image_texel(scene, t, column + 1, row, w);
  const double bottom = (1 - fx) * image_texel(scene, t, column, row + 1, w) + fx * image_texel(scene, t, column + 1, row + 1, w);
  return (1 - fy) * top + fy * bottom;
}

bool on_wire(const Texture& t, const SurfacePoint& p) {
  if (p.kind == PrimitiveKind::Triangle) return std::min({p.b1, p.b2, 1 - p.b1 - p.b2}) < t.parameter;
  return std::min({p.u, 1 - p.u, p.v, 1 - p.v}) < t.parameter;
}

bool inside_shape(const layout::Region& r, Vec3d p) {
  const Vec3d a = vec(r.a), b = vec(r.b);
  switch (r.shape) {
    case layout::REGION_SPHERE: return length_squared(p - a) <= square(r.radius);
    case layout::REGION_BOX: {
      const Vec3d low = min(a, b), high = max(a, b);
      return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
    }
    case layout::REGION_CAPSULE: {
      const Vec3d axis = b - a;
      const double along = length_squared(axis) > 0 ? std::clamp(dot(p - a, axis) / length_squared(axis), 0.0, 1.0) : 0;
      return length_squared(p - (a + axis * along)) <= square(r.radius);
    }
  }
  return false;
}

bool in_region(const CompiledScene& scene, const Texture& t, Vec3d world) {
  const Vec3d p = to_texture(t, world);
  for (std::uint32_t i = 0; i < t.shape_count; i++)
    if (inside_shape(scene.regions[t.first_shape + i], p)) return true;
  return false;
}

double vertex_mask(const CompiledScene& scene, const Texture& t, const SurfacePoint& p) {
  if (p.kind != PrimitiveKind::Triangle) return 0;
  const layout::Triangle& triangle = scene.triangles[primitive_ref(scene, p.primitive).index];
  const float* mask = &scene.texels[t.image_offset];
  return mask[triangle.v0] * (1 - p.b1 - p.b2) + mask[triangle.v1] * p.b1 + mask[triangle.v2] * p.b2;
}

}  // namespace

double texel_eval(const float* texel, Wavelength w) {
  if (w.channel >= 0) return texel[w.channel];
  const double t = (std::max(w.nm, 380.0) - STOKES_LAMBDA_MIN) / (STOKES_LAMBDA_MAX - STOKES_LAMBDA_MIN);
  const double x = (texel[0] * t + texel[1]) * t + texel[2];
  // The two branches are one formula; the second keeps its digits where the value is small.
  const double root = std::sqrt(1 + x * x);
  const double sigmoid = x > 0 ? 0.5 + 0.5 * x / root : 0.5 / (root * (root - x));
  return texel[3] * sigmoid;
}

double texture_eval(const CompiledScene& scene, std::uint32_t texture, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  const Texture& t = scene.textures[texture];
  switch (t.type) {
    case layout::TEXTURE_CHECKER: return color_eval(scene, is_odd(t, point.position) ? t.b : t.a, point, wo, w);
    case layout::TEXTURE_MARBLE: {
      const double base = marble_base(t, point.position);
      return base * color_eval(scene, t.a, point, wo, w) + (1 - base) * color_eval(scene, t.b, point, wo, w);
    }
    case layout::TEXTURE_IMAGE: {
      const double illuminant = t.b == STOKES_NONE ? 1 : spectrum_eval(scene, t.b, w);
      return illuminant * image_eval(scene, t, point.u, point.v, w);
    }
    case layout::TEXTURE_WIREFRAME: return color_eval(scene, on_wire(t, point) ? t.b : t.a, point, wo, w);
    case layout::TEXTURE_FRESNEL: return fresnel_dielectric(std::min(1.0, std::abs(dot(wo, point.ns))), t.parameter);
    case layout::TEXTURE_REGION: return in_region(scene, t, point.position) ? 1 : 0;
    case layout::TEXTURE_VERTEX_MASK: return vertex_mask(scene, t, point);
  }
  return 0;
}

double color_eval(const CompiledScene& scene, std::uint32_t reference, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  if (reference & STOKES_TEXTURE_BIT) return texture_eval(scene, reference & ~STOKES_TEXTURE_BIT, point, wo, w);
  return spectrum_eval(scene, reference, w);
}

}  // namespace stokes::reference
