// Ray against quad, triangle, sphere and ellipsoid, in double. See intersect.h.
#include "reference/intersect.h"

#include "reference/sampling.h"

namespace stokes::reference {
namespace {

/// Moller & Trumbore 1997 for the plane corner + u a + v b: false when parallel, else t and the parameters.
bool intersect_plane(Vec3d corner, Vec3d a, Vec3d b, const Ray& ray, Hit& hit) {
  const Vec3d p = cross(ray.d, b);
  const double determinant = dot(a, p);
  if (determinant == 0) return false;
  const Vec3d from_corner = ray.o - corner;
  const Vec3d q = cross(from_corner, a);
  hit.u = dot(from_corner, p) / determinant;
  hit.v = dot(ray.d, q) / determinant;
  hit.t = dot(b, q) / determinant;
  return true;
}

bool intersect_quad(const layout::Quad& quad, const Ray& ray, Hit& hit) {
  return intersect_plane(vec(quad.corner), vec(quad.edge_u), vec(quad.edge_v), ray, hit) && hit.u >= 0 && hit.u <= 1 && hit.v >= 0 &&
         hit.v <= 1;
}

bool intersect_triangle(const CompiledScene& scene, const layout::Triangle& t, const Ray& ray, Hit& hit) {
  const Vec3d v0 = vec(scene.positions[t.v0]), v1 = vec(scene.positions[t.v1]), v2 = vec(scene.positions[t.v2]);
  return intersect_plane(v0, v1 - v0, v2 - v0, ray, hit) && hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1;
}

/// The unit sphere about the origin for a ray o + t d in its space, d of any length; the first t beyond t_min.
bool intersect_unit_sphere(Vec3d o, Vec3d d, bool starts_on_it, double t_min, Hit& hit) {
  const double a = dot(d, d), middle = -dot(o, d) / a;
  // A start on the sphere is one of the two roots: it is 0, and the other is twice the middle.
  if (starts_on_it) {
    hit.t = 2 * middle;
    return hit.t > t_min;
  }
  const double discriminant = 1 - length_squared(o + d * middle);
  if (discriminant < 0) return false;
  const double half_chord = std::sqrt(discriminant / a);
  hit.t = middle - half_chord > t_min ? middle - half_chord : middle + half_chord;
  return hit.t > t_min;
}

bool intersect_sphere(const layout::Sphere& s, const Ray& ray, bool starts_on_it, double t_min, Hit& hit) {
  const double r = s.radius;
  return intersect_unit_sphere((ray.o - vec(s.center)) / r, ray.d / r, starts_on_it, t_min, hit);
}

bool intersect_ellipsoid(const layout::Ellipsoid& e, const Ray& ray, bool starts_on_it, double t_min, Hit& hit) {
  const EllipsoidMaps maps = ellipsoid_maps(e);
  return intersect_unit_sphere(maps.to_local.point(ray.o), maps.to_local.vector(ray.d), starts_on_it, t_min, hit);
}

}  // namespace

EllipsoidMaps ellipsoid_maps(const layout::Ellipsoid& e) {
  EllipsoidMaps maps;
  for (std::size_t i = 0; i < 12; i++) maps.to_local.m[i] = e.to_local[i];
  maps.to_world = maps.to_local.inverse();
  return maps;
}

std::uint32_t primitive_count(const CompiledScene& scene) {
  return static_cast<std::uint32_t>(scene.quads.size() + scene.spheres.size() + scene.ellipsoids.size() + scene.triangles.size());
}

PrimitiveRef primitive_ref(const CompiledScene& scene, std::uint32_t primitive) {
  const auto quads = static_cast<std::uint32_t>(scene.quads.size()), spheres = static_cast<std::uint32_t>(scene.spheres.size()),
             ellipsoids = static_cast<std::uint32_t>(scene.ellipsoids.size());
  if (primitive < quads) return {PrimitiveKind::Quad, primitive};
  primitive -= quads;
  if (primitive < spheres) return {PrimitiveKind::Sphere, primitive};
  primitive -= spheres;
  if (primitive < ellipsoids) return {PrimitiveKind::Ellipsoid, primitive};
  return {PrimitiveKind::Triangle, primitive - ellipsoids};
}

std::uint32_t light_primitive(const CompiledScene& scene, const layout::Light& light) {
  const auto quads = static_cast<std::uint32_t>(scene.quads.size()), spheres = static_cast<std::uint32_t>(scene.spheres.size()),
             ellipsoids = static_cast<std::uint32_t>(scene.ellipsoids.size());
  switch (light.type) {
    case layout::LIGHT_QUAD: return light.primitive;
    case layout::LIGHT_SPHERE: return quads + light.primitive;
    case layout::LIGHT_ELLIPSOID: return quads + spheres + light.primitive;
    case layout::LIGHT_TRIANGLE: return quads + spheres + ellipsoids + light.primitive;
    case layout::LIGHT_BACKGROUND:
    case layout::LIGHT_ENVIRONMENT: break;
  }
  return STOKES_NONE;
}

const layout::Surface& primitive_surface(const CompiledScene& scene, std::uint32_t primitive) {
  const auto [kind, i] = primitive_ref(scene, primitive);
  switch (kind) {
    case PrimitiveKind::Quad: return scene.surfaces[scene.quads[i].surface];
    case PrimitiveKind::Sphere: return scene.surfaces[scene.spheres[i].surface];
    case PrimitiveKind::Ellipsoid: return scene.surfaces[scene.ellipsoids[i].surface];
    case PrimitiveKind::Triangle: break;
  }
  return scene.surfaces[scene.triangles[i].surface];
}

bool is_hollow(const CompiledScene& scene, std::uint32_t primitive) {
  if (primitive == STOKES_NONE) return false;
  const auto [kind, i] = primitive_ref(scene, primitive);
  return (kind == PrimitiveKind::Sphere && scene.spheres[i].flip) || (kind == PrimitiveKind::Ellipsoid && scene.ellipsoids[i].flip);
}

Box primitive_bounds(const CompiledScene& scene, std::uint32_t primitive) {
  const auto [kind, i] = primitive_ref(scene, primitive);
  switch (kind) {
    case PrimitiveKind::Quad: {
      const layout::Quad& q = scene.quads[i];
      const Vec3d c = vec(q.corner), u = vec(q.edge_u), v = vec(q.edge_v);
      return {min(min(c, c + u), min(c + v, c + u + v)), max(max(c, c + u), max(c + v, c + u + v))};
    }
    case PrimitiveKind::Sphere: {
      const layout::Sphere& s = scene.spheres[i];
      const Vec3d c = vec(s.center), r = {s.radius, s.radius, s.radius};
      return {c - r, c + r};
    }
    case PrimitiveKind::Ellipsoid: {
      // The support of the image of the unit sphere along an axis is the length of that row.
      const Affine m = ellipsoid_maps(scene.ellipsoids[i]).to_world;
      const Vec3d c = m.translation();
      const Vec3d r = {length({m.m[0], m.m[1], m.m[2]}), length({m.m[4], m.m[5], m.m[6]}), length({m.m[8], m.m[9], m.m[10]})};
      return {c - r, c + r};
    }
    case PrimitiveKind::Triangle: break;
  }
  const layout::Triangle& t = scene.triangles[i];
  const Vec3d a = vec(scene.positions[t.v0]), b = vec(scene.positions[t.v1]), c = vec(scene.positions[t.v2]);
  return {min(a, min(b, c)), max(a, max(b, c))};
}

void intersect_primitive(const CompiledScene& scene, std::uint32_t primitive, const Ray& ray, double t_min, Hit& hit) {
  const auto [kind, i] = primitive_ref(scene, primitive);
  const bool starts_on_it = ray.left == primitive;
  Hit candidate;
  bool met = false;
  switch (kind) {
    case PrimitiveKind::Quad: met = !starts_on_it && intersect_quad(scene.quads[i], ray, candidate); break;
    case PrimitiveKind::Sphere: met = intersect_sphere(scene.spheres[i], ray, starts_on_it, t_min, candidate); break;
    case PrimitiveKind::Ellipsoid: met = intersect_ellipsoid(scene.ellipsoids[i], ray, starts_on_it, t_min, candidate); break;
    case PrimitiveKind::Triangle: met = !starts_on_it && intersect_triangle(scene, scene.triangles[i], ray, candidate); break;
  }
  if (!met || !(candidate.t > t_min) || !(candidate.t < hit.t)) return;
  hit = candidate;
  hit.primitive = primitive;
}

}  // namespace stokes::reference
