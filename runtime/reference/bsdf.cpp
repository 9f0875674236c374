// Reading a hit's material, the dispatchers over its type, and the two simplest types: lambertian and darts' metal. See bsdf.h.
#include "reference/bsdf.h"

#include "reference/sampling.h"

namespace stokes::reference {
namespace {

constexpr int kMaxBlendDepth = 8;

double table_or(const CompiledScene& scene, std::uint32_t reference, double fallback, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  return reference == STOKES_NONE ? fallback : color_eval(scene, reference, point, wo, w);
}

/// Both normals on wo's side, by the geometric one's sign: a smooth mesh stays bright up to its silhouette.
void set_normals(Bsdf& bsdf, const SurfacePoint& point, Vec3d wo) {
  const double side = dot(wo, point.ng) < 0 ? -1 : 1;
  bsdf.ng = point.ng * side;
  bsdf.n = point.ns * side;
}

BsdfSample lambertian_sample(const Bsdf& bsdf, Random& random) {
  const double u1 = random.next(), u2 = random.next();
  const Vec3d wi = Frame(bsdf.n).to_world(sample_cosine_hemisphere(u1, u2));
  const double cosine = dot(wi, bsdf.n);
  if (cosine <= 0 || dot(wi, bsdf.ng) <= 0) return {};
  return {wi, bsdf.albedo, cosine / kPi, 1};
}

BsdfSample metal_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  const double u1 = random.next(), u2 = random.next(), u3 = random.next();
  const Vec3d direction = mirror(wo, bsdf.n) + bsdf.parameter * sample_ball(u1, u2, u3);
  if (length_squared(direction) == 0 || dot(direction, bsdf.n) <= 0 || dot(direction, bsdf.ng) <= 0) return {};
  return {normalize(direction), bsdf.albedo, 0, 1};
}

}  // namespace

std::uint32_t resolve_blends(const CompiledScene& scene, std::uint32_t material, const SurfacePoint& point, Vec3d wo, Wavelength w, Random& random) {
  for (int depth = 0; depth < kMaxBlendDepth; depth++) {
    const layout::Material& m = scene.materials[material];
    if (m.type != layout::MATERIAL_BLEND) return material;
    const double amount = m.amount_texture == STOKES_NONE ? m.amount : texture_eval(scene, m.amount_texture, point, wo, w);
    material = random.next() < amount ? m.child_b : m.child_a;
  }
  return material;
}

Bsdf lambertian_at(const SurfacePoint& point, Vec3d wo, double albedo) {
  Bsdf bsdf;
  bsdf.type = layout::MATERIAL_LAMBERTIAN;
  bsdf.albedo = albedo;
  set_normals(bsdf, point, wo);
  return bsdf;
}

Bsdf bsdf_at(const CompiledScene& scene, const layout::Material& m, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  Bsdf bsdf;
  bsdf.type = m.type;
  bsdf.parameter = m.parameter;
  set_normals(bsdf, point, wo);
  switch (m.type) {
    case layout::MATERIAL_FLUORESCENT:
    case layout::MATERIAL_RERADIATION: bsdf.type = layout::MATERIAL_LAMBERTIAN; [[fallthrough]];
    case layout::MATERIAL_LAMBERTIAN: bsdf.albedo = table_or(scene, m.albedo, 0, point, wo, w); return bsdf;
    case layout::MATERIAL_METAL:
    case layout::MATERIAL_PHONG:
    case layout::MATERIAL_BLINN_PHONG: bsdf.albedo = table_or(scene, m.albedo, 0, point, wo, w); break;
    case layout::MATERIAL_CONDUCTOR:
      bsdf.eta = table_or(scene, m.eta, 1, point, wo, w);
      bsdf.k = table_or(scene, m.k, 0, point, wo, w);
      break;
    case layout::MATERIAL_DIELECTRIC: {
      const double inside_over_outside = table_or(scene, m.eta, 1, point, wo, w);
      bsdf.eta = dot(wo, point.ng) < 0 ? 1 / inside_over_outside : inside_over_outside;
      bsdf.albedo = table_or(scene, m.albedo, 1, point, wo, w);
      break;
    }
    default: return bsdf;  // black, and interface, which the path passes without asking
  }
  // A mirror direction about a normal that faces away from wo has no meaning.
  if (dot(bsdf.n, wo) <= 0) bsdf.n = bsdf.ng;
  return bsdf;
}

bool is_specular(const Bsdf& bsdf) {
  switch (bsdf.type) {
    case layout::MATERIAL_METAL: return true;
    case layout::MATERIAL_CONDUCTOR: return bsdf.parameter <= 0;
    case layout::MATERIAL_DIELECTRIC: return bsdf.parameter <= 0 || bsdf.eta == 1;
    default: return false;
  }
}

double bsdf_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  if (is_specular(bsdf)) return 0;
  switch (bsdf.type) {
    case layout::MATERIAL_LAMBERTIAN: return dot(wi, bsdf.ng) > 0 ? bsdf.albedo * std::max(0.0, dot(wi, bsdf.n)) / kPi : 0;
    case layout::MATERIAL_CONDUCTOR: return conductor_eval(bsdf, wo, wi);
    case layout::MATERIAL_DIELECTRIC: return dielectric_eval(bsdf, wo, wi);
    case layout::MATERIAL_PHONG: return phong_eval(bsdf, wo, wi);
    case layout::MATERIAL_BLINN_PHONG: return blinn_phong_eval(bsdf, wo, wi);
    default: return 0;
  }
}

double bsdf_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  if (is_specular(bsdf)) return 0;
  switch (bsdf.type) {
    case layout::MATERIAL_LAMBERTIAN: return dot(wi, bsdf.ng) > 0 ? std::max(0.0, dot(wi, bsdf.n)) / kPi : 0;
    case layout::MATERIAL_CONDUCTOR: return conductor_pdf(bsdf, wo, wi);
    case layout::MATERIAL_DIELECTRIC: return dielectric_pdf(bsdf, wo, wi);
    case layout::MATERIAL_PHONG: return phong_pdf(bsdf, wo, wi);
    case layout::MATERIAL_BLINN_PHONG: return blinn_phong_pdf(bsdf, wo, wi);
    default: return 0;
  }
}

BsdfSample bsdf_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  switch (bsdf.type) {
    case layout::MATERIAL_LAMBERTIAN: return lambertian_sample(bsdf, random);
    case layout::MATERIAL_METAL: return metal_sample(bsdf, wo, random);
    case layout::MATERIAL_CONDUCTOR: return conductor_sample(bsdf, wo, random);
    case layout::MATERIAL_DIELECTRIC: return dielectric_sample(bsdf, wo, random);
    case layout::MATERIAL_PHONG: return phong_sample(bsdf, wo, random);
    case layout::MATERIAL_BLINN_PHONG: return blinn_phong_sample(bsdf, wo, random);
    default: return {};
  }
}

}  // namespace stokes::reference
