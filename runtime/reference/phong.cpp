// Phong and Blinn-Phong as darts means them: the value is the albedo times the density of their lobe. See bsdf.h.
#include "reference/bsdf.h"
#include "reference/sampling.h"

namespace stokes::reference {
namespace {

bool above(const Bsdf& bsdf, Vec3d wi) { return dot(wi, bsdf.n) > 0 && dot(wi, bsdf.ng) > 0; }

/// Density (n + 1) / (2 pi) cos^n.
double cosine_power_pdf(double n, double cosine) { return cosine > 0 ? (n + 1) / (2 * kPi) * std::pow(cosine, n) : 0; }

BsdfSample finish(const Bsdf& bsdf, Vec3d wi, double pdf) {
  if (!above(bsdf, wi) || pdf <= 0) return {};
  return {wi, bsdf.albedo, pdf, 1};
}

}  // namespace

// A density of directions whatever the surface; what falls below it is lost.
double phong_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi) { return cosine_power_pdf(bsdf.parameter, dot(mirror(wo, bsdf.n), wi)); }

double phong_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi) { return above(bsdf, wi) ? bsdf.albedo * phong_pdf(bsdf, wo, wi) : 0; }

BsdfSample phong_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  const double u1 = random.next(), u2 = random.next();
  const Vec3d wi = Frame(mirror(wo, bsdf.n)).to_world(sample_cosine_power(bsdf.parameter, u1, u2));
  return finish(bsdf, wi, phong_pdf(bsdf, wo, wi));
}

double blinn_phong_pdf(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  const Vec3d sum = wo + wi;
  if (length_squared(sum) == 0) return 0;
  const Vec3d h = normalize(sum);
  return cosine_power_pdf(bsdf.parameter, dot(h, bsdf.n)) / (4 * std::abs(dot(wo, h)));
}

double blinn_phong_eval(const Bsdf& bsdf, Vec3d wo, Vec3d wi) {
  return above(bsdf, wi) ? bsdf.albedo * blinn_phong_pdf(bsdf, wo, wi) : 0;
}

BsdfSample blinn_phong_sample(const Bsdf& bsdf, Vec3d wo, Random& random) {
  const double u1 = random.next(), u2 = random.next();
  const Vec3d h = Frame(bsdf.n).to_world(sample_cosine_power(bsdf.parameter, u1, u2));
  const Vec3d wi = mirror(wo, h);
  return finish(bsdf, wi, blinn_phong_pdf(bsdf, wo, wi));
}

}  // namespace stokes::reference
