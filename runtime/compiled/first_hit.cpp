// Brute-force intersection. See first_hit.h.
#include "compiled/first_hit.h"

#include <cmath>

#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

struct Search {
  Vec3d o, d;
  std::optional<FirstHit> best;

  bool closer(double t) const { return t > 0 && std::isfinite(t) && (!best || t < best->t); }
};

void test_quad(Search& s, const layout::Quad& q, std::uint32_t index) {
  const Vec3d n = to_double(q.normal);
  const double t = (q.offset - dot(n, s.o)) / dot(n, s.d);
  if (!s.closer(t)) return;
  const Vec3d p = s.o + s.d * t;
  const double u = dot(to_double(q.dual_u), p) - q.u0, v = dot(to_double(q.dual_v), p) - q.v0;
  if (u >= 0 && u <= 1 && v >= 0 && v <= 1) s.best = {t, index, q.surface, n};
}

// The nearer positive root of |o + t d|^2 = r^2, or NaN.
double sphere_root(Vec3d o, Vec3d d, double r) {
  const double a = dot(d, d), b = dot(o, d);
  const Vec3d nearest = o - d * (b / a);
  const double discriminant = r * r - dot(nearest, nearest);
  if (discriminant < 0) return NAN;
  const double half = std::sqrt(discriminant / a), near = -b / a - half;
  return near > 0 ? near : -b / a + half;
}

void test_sphere(Search& s, const layout::Sphere& sphere, std::uint32_t index) {
  const Vec3d center = to_double(sphere.center);
  const double t = sphere_root(s.o - center, s.d, sphere.radius);
  if (s.closer(t)) s.best = {t, index, sphere.surface, normalize(s.o + s.d * t - center) * (sphere.flip ? -1.0 : 1.0)};
}

void test_ellipsoid(Search& s, const layout::Ellipsoid& e, std::uint32_t index) {
  Affine to_local;
  for (std::size_t i = 0; i < 12; i++) to_local.m[i] = e.to_local[i];
  const Vec3d o = to_local.point(s.o), d = to_local.vector(s.d);
  const double t = sphere_root(o, d, 1);
  if (!s.closer(t)) return;
  const Vec3d n = o + d * t, rows[3] = {{to_local.m[0], to_local.m[1], to_local.m[2]}, {to_local.m[4], to_local.m[5], to_local.m[6]}, {to_local.m[8], to_local.m[9], to_local.m[10]}};
  const Vec3d world = rows[0] * n.x + rows[1] * n.y + rows[2] * n.z;  // the transpose of the inverse map
  s.best = {t, index, e.surface, normalize(world) * (e.flip ? -1.0 : 1.0)};
}

// Moeller and Trumbore 1997.
void test_triangle(Search& s, const CompiledScene& scene, const layout::Triangle& triangle, std::uint32_t index) {
  const Vec3d p0 = to_double(scene.positions[triangle.v0]);
  const Vec3d e1 = to_double(scene.positions[triangle.v1]) - p0, e2 = to_double(scene.positions[triangle.v2]) - p0;
  const Vec3d p = cross(s.d, e2), q = cross(s.o - p0, e1);
  const double determinant = dot(e1, p);
  if (determinant == 0) return;
  const double u = dot(s.o - p0, p) / determinant, v = dot(s.d, q) / determinant, t = dot(e2, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1 || !s.closer(t)) return;
  s.best = {t, index, triangle.surface, normalize(cross(e1, e2))};
}

}  // namespace

std::optional<FirstHit> first_hit(const CompiledScene& scene, Vec3d origin, Vec3d direction) {
  Search s{origin, direction, std::nullopt};
  std::uint32_t index = 0;
  for (const layout::Quad& q : scene.quads) test_quad(s, q, index++);
  for (const layout::Sphere& sphere : scene.spheres) test_sphere(s, sphere, index++);
  for (const layout::Ellipsoid& e : scene.ellipsoids) test_ellipsoid(s, e, index++);
  for (const layout::Triangle& t : scene.triangles) test_triangle(s, scene, t, index++);
  return s.best;
}

}  // namespace stokes::compiled
