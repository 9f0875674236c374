// GGX conductor, single scattering; a mirror at alpha 0. See bsdf.h.
#include "reference/bsdf.h"
#include "reference/fresnel.h"
#include "reference/microfacet.h"
#include "reference/sampling.h"

namespace stokes::reference {

double conductor_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Frame frame(bsdf.n);
  const Vec3d o = frame.to_local(wo), i = frame.to_local(wi);
  if (o.z <= 0 || i.z <= 0 || dot(wi, bsdf.ng) <= 0) return 0;
  const Vec3d h = normalize(o + i);
  return ggx_visible_pdf(o, h, bsdf.parameter) / (4 * dot(o, h));
}

double conductor_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Frame frame(bsdf.n);
  const Vec3d o = frame.to_local(wo), i = frame.to_local(wi);
  if (o.z <= 0 || i.z <= 0 || dot(wi, bsdf.ng) <= 0) return 0;
  const Vec3d h = normalize(o + i);
  return fresnel_conductor(dot(o, h), bsdf.eta, bsdf.k) * ggx_d(h, bsdf.parameter) * ggx_g2(o, i, bsdf.parameter) / (4 * o.z);
}

BsdfSample conductor_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  if (is_specular(bsdf)) {
    const Vec3d wi = mirror(wo, bsdf.n);
    if (dot(wi, bsdf.ng) <= 0) return {};
    return {wi, fresnel_conductor(std::min(1.0, dot(wo, bsdf.n)), bsdf.eta, bsdf.k), 0, 1};
  }
  const double u1 = random.next(), u2 = random.next();
  const Frame frame(bsdf.n);
  const Vec3d o = frame.to_local(wo);
  const Vec3d h = ggx_sample_visible(o, bsdf.parameter, u1, u2);
  const Vec3d wi = frame.to_world(mirror(o, h));
  const double pdf = conductor_pdf(bsdf, wo, wi);
  if (pdf <= 0) return {};
  return {wi, conductor_eval(bsdf, wo, wi) / pdf, pdf, 1};
}

}  // namespace stokes::reference
