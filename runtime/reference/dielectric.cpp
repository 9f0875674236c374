// Smooth dielectric boundary, and the GGX rough one of Walter et al. 2007. `eta` is the index beyond the surface over the index on wo's
// side; radiance that refracts towards wo is scaled by 1 / eta^2. See bsdf.h.
#include "reference/bsdf.h"
#include "reference/fresnel.h"
#include "reference/microfacet.h"
#include "reference/sampling.h"

namespace stokes::reference {
namespace {

/// wo refracted at a plane of normal n on wo's side; `cosine_beyond` from Fresnel's equations.
Vec3d refract(Vec3d wo, Vec3d n, double eta, double cosine_beyond) {
  return (n * dot(wo, n) - wo) / eta - n * cosine_beyond;
}

BsdfSample smooth_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  double cosine_beyond;
  const double reflectance = fresnel_dielectric(std::min(1.0, dot(wo, bsdf.n)), bsdf.eta, &cosine_beyond);
  if (random.next() < reflectance) {
    const Vec3d wi = mirror(wo, bsdf.n);
    if (dot(wi, bsdf.ng) <= 0) return {};
    return {wi, bsdf.albedo, 0, 1};
  }
  const Vec3d wi = normalize(refract(wo, bsdf.n, bsdf.eta, cosine_beyond));
  if (dot(wi, bsdf.ng) >= 0) return {};
  return {wi, bsdf.albedo / square(bsdf.eta), 0, bsdf.eta};
}

/// What eval and pdf share about a pair of directions: the microfacet that connects them.
struct Facet {
  bool valid = false, reflects = false;
  Vec3d o, i, h;           // in the frame of n; h on the side of n
  double reflectance = 0;  // Fresnel at h
  double jacobian = 0;     // density of wi over density of h
};

Facet find_facet(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Frame frame(bsdf.n);
  Facet f;
  f.o = frame.to_local(wo);
  f.i = frame.to_local(wi);
  f.reflects = f.i.z > 0;
  if (f.o.z <= 0 || f.i.z == 0 || (dot(wi, bsdf.ng) > 0) != f.reflects) return f;
  Vec3d h = f.reflects ? f.o + f.i : f.o + f.i * bsdf.eta;
  if (length_squared(h) == 0) return f;
  h = normalize(h);
  f.h = h.z < 0 ? -h : h;
  const double oh = dot(f.o, f.h), ih = dot(f.i, f.h);
  // Both must see the facet from the side they claim.
  if (oh <= 0 || (f.reflects ? ih <= 0 : ih >= 0)) return f;
  f.reflectance = fresnel_dielectric(oh, bsdf.eta);
  f.jacobian = f.reflects ? 1 / (4 * oh) : square(bsdf.eta) * std::abs(ih) / square(oh + bsdf.eta * ih);
  f.valid = true;
  return f;
}

}  // namespace

double dielectric_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Facet f = find_facet(bsdf, wo, wi);
  if (!f.valid) return 0;
  const double choice = f.reflects ? f.reflectance : 1 - f.reflectance;
  return choice * ggx_visible_pdf(f.o, f.h, bsdf.parameter) * f.jacobian;
}

double dielectric_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Facet f = find_facet(bsdf, wo, wi);
  if (!f.valid) return 0;
  const double shape = ggx_d(f.h, bsdf.parameter) * ggx_g2(f.o, f.i, bsdf.parameter) * dot(f.o, f.h) / f.o.z * f.jacobian;
  if (f.reflects) return bsdf.albedo * f.reflectance * shape;
  return bsdf.albedo * (1 - f.reflectance) * shape / square(bsdf.eta);
}

BsdfSample dielectric_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  if (is_specular(bsdf)) return smooth_sample(bsdf, wo, random);
  const double u1 = random.next(), u2 = random.next(), choice = random.next();
  const Frame frame(bsdf.n);
  const Vec3d o = frame.to_local(wo);
  const Vec3d h = ggx_sample_visible(o, bsdf.parameter, u1, u2);
  double cosine_beyond;
  const bool reflects = choice < fresnel_dielectric(dot(o, h), bsdf.eta, &cosine_beyond);
  const Vec3d wi = normalize(frame.to_world(reflects ? mirror(o, h) : refract(o, h, bsdf.eta, cosine_beyond)));
  // A reflection that ends below the surface, or a refraction above it, is lost; it must not pass for the other.
  if ((dot(wi, bsdf.n) > 0) != reflects) return {};
  const double pdf = dielectric_pdf(bsdf, wo, wi);
  if (pdf <= 0) return {};
  return {wi, dielectric_eval(bsdf, wo, wi) / pdf, pdf, reflects ? 1 : bsdf.eta};
}

}  // namespace stokes::reference
