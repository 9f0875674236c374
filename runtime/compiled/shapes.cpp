// Quads, spheres and ellipsoids under affine maps. See shapes.h.
#include "compiled/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stokes::compiled {

void set_quad_reach(layout::Quad& q) {
  constexpr double kRounding = 0x1p-22;
  const auto sum = [](layout::Vec3 a) { return std::abs(double(a.x)) + std::abs(double(a.y)) + std::abs(double(a.z)); };
  const double extent = sum(q.edge_u) + sum(q.edge_v);
  q.reach_u = float(0.5 + kRounding * extent * sum(q.dual_u));
  q.reach_v = float(0.5 + kRounding * extent * sum(q.dual_v));
  q.growth_u = float(kRounding * (1 + std::sqrt(3.0)) * sum(q.dual_u));
  q.growth_v = float(kRounding * (1 + std::sqrt(3.0)) * sum(q.dual_v));
}

std::optional<layout::Quad> make_quad(const Affine& to_world, double width, double height, bool flip) {
  // The corners as the device will have them; everything else follows from these floats.
  layout::Quad q{};
  q.corner = to_float(to_world.point({-width / 2, -height / 2, 0}));
  q.edge_u = to_float(to_world.vector({width, 0, 0}));
  q.edge_v = to_float(to_world.vector({0, height, 0}));
  const Vec3d corner = to_double(q.corner), u = to_double(q.edge_u), v = to_double(q.edge_v);
  const Vec3d n = cross(u, v);
  const double area = length(n);
  if (!(area > 0) || !std::isfinite(area)) return std::nullopt;

  // The front side is the side that the local +z points to, whatever the winding became.
  const Vec3d front = to_world.normal({0, 0, 1}) * (flip ? -1.0 : 1.0);
  q.normal = to_float(n * ((dot(n, front) < 0 ? -1.0 : 1.0) / area));
  q.offset = float(dot(to_double(q.normal), corner));
  q.area = float(area);

  // Dual vectors: dot(dual_u, edge_u) = 1, dot(dual_u, edge_v) = 0, and the other way round.
  const Vec3d dual_u = cross(v, n) / dot(n, n), dual_v = cross(n, u) / dot(n, n);
  q.dual_u = to_float(dual_u);
  q.dual_v = to_float(dual_v);
  q.u0 = float(dot(to_double(q.dual_u), corner));
  q.v0 = float(dot(to_double(q.dual_v), corner));
  q.light = STOKES_NONE;
  set_quad_reach(q);
  return q;
}

std::optional<double> uniform_scale(const Affine& a) {
  const Vec3d x = a.column(0), y = a.column(1), z = a.column(2);
  const double s2 = (dot(x, x) + dot(y, y) + dot(z, z)) / 3, tolerance = 1e-6 * s2;
  for (double d : {dot(x, x) - s2, dot(y, y) - s2, dot(z, z) - s2, dot(x, y), dot(y, z), dot(z, x)})
    if (!(std::abs(d) <= tolerance)) return std::nullopt;
  return std::sqrt(s2);
}

layout::Sphere make_sphere(const Affine& to_world, double radius, bool flip) {
  const double scale = *uniform_scale(to_world);
  layout::Sphere s{};
  s.center = to_float(to_world.translation());
  s.radius = float(radius * scale);
  // The inverse of a scaled rotation is its transpose over the scale squared; row i is column i.
  for (int i = 0; i < 3; i++) {
    const Vec3d row = to_world.column(i) / scale;
    s.to_local[3 * i] = float(row.x), s.to_local[3 * i + 1] = float(row.y), s.to_local[3 * i + 2] = float(row.z);
  }
  s.light = STOKES_NONE;
  s.flip = flip;
  return s;
}

namespace {

// Square roots of the eigenvalues of the Gram matrix of three columns, the largest first.
std::array<double, 3> singular_values(Vec3d x, Vec3d y, Vec3d z) {
  const double xy = dot(x, y), yz = dot(y, z), zx = dot(z, x), mean = (dot(x, x) + dot(y, y) + dot(z, z)) / 3;
  const double dx = dot(x, x) - mean, dy = dot(y, y) - mean, dz = dot(z, z) - mean;
  const double spread = std::sqrt((dx * dx + dy * dy + dz * dz + 2 * (xy * xy + yz * yz + zx * zx)) / 6);
  const double determinant = dx * (dy * dz - yz * yz) - xy * (xy * dz - yz * zx) + zx * (xy * yz - dy * zx);
  const double cosine = spread > 0 ? determinant / (2 * spread * spread * spread) : 1;
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / 3, third = 2 * std::numbers::pi / 3;
  const auto value = [&](double turn) { return std::sqrt(std::max(mean + 2 * spread * std::cos(angle + turn), 0.0)); };
  return {value(0), value(-third), value(third)};
}

// Legendre's formula for semi-axes a >= b >= c, in the products p = ab, q = ac, r = bc, which are the singular values of the map's
// cofactors: good for needles and discs alike. Scenes may have very many ellipsoids, so that nothing is integrated numerically.
double ellipsoid_area(const Affine& m) {
  const Vec3d x = cross(m.column(1), m.column(2)), y = cross(m.column(2), m.column(0)), z = cross(m.column(0), m.column(1));
  const double unit = std::max({length(x), length(y), length(z)});
  const auto [p, raw_q, r] = singular_values(x / unit, y / unit, z / unit);
  const double q = std::max(raw_q, 1e-7 * p), cosine = r / p, sine = std::sqrt((1 - cosine) * (1 + cosine));
  if (!(sine > 1e-6)) return 4 * std::numbers::pi * p * unit;  // a sphere
  const double k = std::sqrt(std::clamp((p - q) * (p + q) / ((p - r) * (p + r)), 0.0, 1.0)), phi = std::acos(cosine);
  return 2 * std::numbers::pi * unit * (q * r / p + p / sine * (std::ellint_2(k, phi) * sine * sine + std::ellint_1(k, phi) * cosine * cosine));
}

}  // namespace

layout::Ellipsoid make_ellipsoid(const Affine& to_world, double radius, bool flip) {
  Affine unit;
  unit.m = {radius, 0, 0, 0, 0, radius, 0, 0, 0, 0, radius, 0};
  const Affine world = to_world * unit, local = world.inverse();
  layout::Ellipsoid e{};
  for (int i = 0; i < 12; i++) e.to_world[i] = float(world.m[i]), e.to_local[i] = float(local.m[i]);
  e.area = float(ellipsoid_area(world));
  e.light = STOKES_NONE;
  e.flip = flip;
  return e;
}

}  // namespace stokes::compiled
