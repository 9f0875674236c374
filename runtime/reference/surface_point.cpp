// Normals, texture coordinates and surface data of a point on a primitive. See intersect.h.
#include "reference/intersect.h"
#include "reference/sampling.h"

namespace stokes::reference {
namespace {

/// Longitude and latitude of a point on the unit sphere, poles on local z (darts' convention).
void set_sphere_uv(SurfacePoint& p, Vec3d local) {
  p.u = (std::atan2(-local.y, -local.x) + kPi) / (2 * kPi);
  p.v = 1 - std::acos(std::clamp(local.z, -1.0, 1.0)) / kPi;
}

void fill_quad(SurfacePoint& p, const layout::Quad& q, double u, double v) {
  const Vec3d n = normalize(cross(vec(q.edge_u), vec(q.edge_v)));
  p.ng = p.ns = dot(n, vec(q.normal)) < 0 ? -n : n;
  p.u = u, p.v = v;
  p.light = q.light;
}

void fill_sphere(SurfacePoint& p, const layout::Sphere& s) {
  const Vec3d n = normalize(p.position - vec(s.center));
  const float* r = s.to_local;
  set_sphere_uv(p, {dot({r[0], r[1], r[2]}, n), dot({r[3], r[4], r[5]}, n), dot({r[6], r[7], r[8]}, n)});
  p.ng = p.ns = s.flip ? -n : n;
  p.light = s.light;
}

void fill_ellipsoid(SurfacePoint& p, const layout::Ellipsoid& e) {
  const EllipsoidMaps maps = ellipsoid_maps(e);
  const Vec3d local = normalize(maps.to_local.point(p.position));
  set_sphere_uv(p, local);
  const Vec3d n = normalize(maps.to_world.normal(local));
  p.ng = p.ns = e.flip ? -n : n;
  p.light = e.light;
}

void fill_triangle(SurfacePoint& p, const CompiledScene& scene, const layout::Triangle& t, double b1, double b2) {
  const Vec3d v0 = vec(scene.positions[t.v0]), v1 = vec(scene.positions[t.v1]), v2 = vec(scene.positions[t.v2]);
  const double b0 = 1 - b1 - b2;
  p.b1 = b1, p.b2 = b2;
  p.ng = p.ns = normalize(cross(v1 - v0, v2 - v0));
  if (p.surface->flags & SURFACE_SMOOTH_NORMALS) {
    const Vec3d n = vec(scene.normals[t.v0]) * b0 + vec(scene.normals[t.v1]) * b1 + vec(scene.normals[t.v2]) * b2;
    // Interpolated normals may vanish; the geometric one stands in.
    if (length_squared(n) > 0) p.ns = normalize(n);
    if (dot(p.ns, p.ng) < 0) p.ns = -p.ns;
  }
  p.u = b1, p.v = b2;
  if (p.surface->flags & SURFACE_HAS_UV) {
    const float *uv0 = &scene.uvs[2 * std::size_t(t.v0)], *uv1 = &scene.uvs[2 * std::size_t(t.v1)], *uv2 = &scene.uvs[2 * std::size_t(t.v2)];
    p.u = uv0[0] * b0 + uv1[0] * b1 + uv2[0] * b2;
    p.v = uv0[1] * b0 + uv1[1] * b1 + uv2[1] * b2;
  }
  p.light = t.light;
}

}  // namespace

SurfacePoint surface_point(const CompiledScene& scene, std::uint32_t primitive, Vec3d position, double u, double v) {
  SurfacePoint p;
  p.position = position;
  p.primitive = primitive;
  p.surface = &primitive_surface(scene, primitive);
  const auto [kind, i] = primitive_ref(scene, primitive);
  p.kind = kind;
  switch (kind) {
    case PrimitiveKind::Quad: fill_quad(p, scene.quads[i], u, v); break;
    case PrimitiveKind::Sphere: fill_sphere(p, scene.spheres[i]); break;
    case PrimitiveKind::Ellipsoid: fill_ellipsoid(p, scene.ellipsoids[i]); break;
    case PrimitiveKind::Triangle: fill_triangle(p, scene, scene.triangles[i], u, v); break;
  }
  return p;
}

}  // namespace stokes::reference
