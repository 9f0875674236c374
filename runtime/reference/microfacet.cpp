// GGX: density, masking, visible normals. See microfacet.h.
#include "reference/microfacet.h"

#include <limits>

#include "reference/sampling.h"

namespace stokes::reference {
namespace {

/// Smith's Lambda: invisible over visible area.
double ggx_lambda(Vec3d v, double alpha) {
  const double cosine2 = v.z * v.z;
  if (cosine2 == 0) return std::numeric_limits<double>::infinity();
  const double tangent2 = std::max(0.0, 1 - cosine2) / cosine2;
  return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

}  // namespace

double ggx_d(Vec3d h, double alpha) {
  if (h.z <= 0) return 0;
  const double a2 = alpha * alpha, sine2 = h.x * h.x + h.y * h.y;
  return a2 / (kPi * square(h.z * h.z * a2 + sine2));
}

double ggx_g1(Vec3d v, double alpha) { return 1 / (1 + ggx_lambda(v, alpha)); }

double ggx_g2(Vec3d v, Vec3d w, double alpha) { return 1 / (1 + ggx_lambda(v, alpha) + ggx_lambda(w, alpha)); }

double ggx_visible_pdf(Vec3d v, Vec3d h, double alpha) {
  return ggx_d(h, alpha) * ggx_g1(v, alpha) * std::max(0.0, dot(v, h)) / std::abs(v.z);
}

Vec3d ggx_sample_visible(Vec3d v, double alpha, double u1, double u2) {
  // Stretch the ellipsoid to a sphere, sample the sphere's projection as seen from v, and shrink back.
  const Vec3d view = normalize(Vec3d{alpha * v.x, alpha * v.y, v.z});
  const double flat = std::hypot(view.x, view.y);
  const Vec3d t1 = flat > 1e-12 ? Vec3d{-view.y / flat, view.x / flat, 0} : Vec3d{1, 0, 0};
  const Vec3d t2 = cross(view, t1);
  // The part of the disk that lies behind the horizon is squeezed onto the rest.
  const Vec3d disk = sample_disk(u1, u2);
  const double s = 0.5 * (1 + view.z);
  const double p1 = disk.x, p2 = (1 - s) * safe_sqrt(1 - p1 * p1) + s * disk.y;
  const Vec3d n = t1 * p1 + t2 * p2 + view * safe_sqrt(1 - p1 * p1 - p2 * p2);
  return normalize(Vec3d{alpha * n.x, alpha * n.y, std::max(1e-12, n.z)});
}

}  // namespace stokes::reference
