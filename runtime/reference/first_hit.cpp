// The integrators that look no further than the first hit: AOVs, normals, ambient occlusion. See volpath.h.
#include "reference/bsdf.h"
#include "reference/sampling.h"
#include "reference/volpath.h"

namespace stokes::reference {
namespace {

double albedo_of(const CompiledScene& scene, const layout::Material& m, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  switch (m.type) {
    case layout::MATERIAL_LAMBERTIAN:
    case layout::MATERIAL_METAL:
    case layout::MATERIAL_PHONG:
    case layout::MATERIAL_BLINN_PHONG:
    case layout::MATERIAL_FLUORESCENT:
    case layout::MATERIAL_RERADIATION: return m.albedo == STOKES_NONE ? 0 : color_eval(scene, m.albedo, point, wo, w);
    case layout::MATERIAL_CONDUCTOR:
    case layout::MATERIAL_DIELECTRIC:
    case layout::MATERIAL_INTERFACE: return 1;
    default: return 0;
  }
}

SurfacePoint point_of(const World& world, const Ray& ray, const Hit& hit) {
  return surface_point(world.scene, hit.primitive, ray.o + ray.d * hit.t, hit.u, hit.v);
}

}  // namespace

FirstHit trace_first_hit(const World& world, const Ray& ray, Wavelength w, Random& random) {
  const Hit hit = world.traversal.closest_hit(ray);
  if (!hit.found()) return {};
  const SurfacePoint point = point_of(world, ray, hit);
  const std::uint32_t material = resolve_blends(world.scene, point.surface->material, point, -ray.d, w, random);
  return {true, hit.t, point.ns, albedo_of(world.scene, world.scene.materials[material], point, -ray.d, w)};
}

double trace_ambient_occlusion(const World& world, const Ray& ray, Random& random) {
  const Hit hit = world.traversal.closest_hit(ray);
  if (!hit.found()) return 0;
  const SurfacePoint point = point_of(world, ray, hit);
  const Vec3d n = lambertian_at(point, -ray.d, 1).n;
  const double u1 = random.next(), u2 = random.next();
  const Ray up = {point.position, Frame(n).to_world(sample_cosine_hemisphere(u1, u2)), point.primitive};
  return world.traversal.closest_hit(up).found() ? 0 : 1;
}

}  // namespace stokes::reference
