// Choosing lights and points on them. See light.h.
#include "reference/light.h"

#include <algorithm>

#include "reference/sampling.h"
#include "reference/texture.h"

namespace stokes::reference {
namespace {

/// True when a sphere light is sampled by the cone it fills: seen from outside, emitting outwards.
bool uses_cone(const layout::Sphere& s, Vec3d from) { return !s.flip && length(from - vec(s.center)) > s.radius; }

/// 1 - cosine of the half angle under which a sphere is seen.
double cone_extent(const layout::Sphere& s, Vec3d from) {
  const double sine2 = square(s.radius) / length_squared(from - vec(s.center));
  return sine2 / (1 + safe_sqrt(1 - sine2));
}

/// Area density of the ellipsoid's image of a uniform point on the unit sphere.
double ellipsoid_area_pdf(const EllipsoidMaps& maps, Vec3d local) {
  // Nanson: a unit area with normal n becomes |det M| |M^-T n|; Affine::normal is det(M) M^-T n.
  return 1 / (4 * kPi * length(maps.to_world.normal(local)));
}

struct AreaPoint {
  Vec3d position;
  double u = 0, v = 0;
  double pdf = 0;  // per area
};

AreaPoint sample_area(const CompiledScene& scene, std::uint32_t primitive, double u1, double u2) {
  const auto [kind, i] = primitive_ref(scene, primitive);
  switch (kind) {
    case PrimitiveKind::Quad: {
      const layout::Quad& q = scene.quads[i];
      const Vec3d a = vec(q.edge_u), b = vec(q.edge_v);
      return {vec(q.corner) + a * u1 + b * u2, u1, u2, 1 / length(cross(a, b))};
    }
    case PrimitiveKind::Sphere: {
      const layout::Sphere& s = scene.spheres[i];
      return {vec(s.center) + double(s.radius) * sample_uniform_sphere(u1, u2), 0, 0, 1 / (4 * kPi * square(s.radius))};
    }
    case PrimitiveKind::Ellipsoid: {
      const EllipsoidMaps maps = ellipsoid_maps(scene.ellipsoids[i]);
      const Vec3d local = sample_uniform_sphere(u1, u2);
      return {maps.to_world.point(local), 0, 0, ellipsoid_area_pdf(maps, local)};
    }
    case PrimitiveKind::Triangle: break;
  }
  const layout::Triangle& t = scene.triangles[i];
  const Vec3d v0 = vec(scene.positions[t.v0]), a = vec(scene.positions[t.v1]) - v0, b = vec(scene.positions[t.v2]) - v0;
  const double root = std::sqrt(u1), b1 = root * (1 - u2), b2 = root * u2;
  return {v0 + a * b1 + b * b2, b1, b2, 2 / length(cross(a, b))};
}

double area_pdf(const CompiledScene& scene, const SurfacePoint& point) {
  const auto [kind, i] = primitive_ref(scene, point.primitive);
  switch (kind) {
    case PrimitiveKind::Quad: return 1 / length(cross(vec(scene.quads[i].edge_u), vec(scene.quads[i].edge_v)));
    case PrimitiveKind::Sphere: return 1 / (4 * kPi * square(scene.spheres[i].radius));
    case PrimitiveKind::Ellipsoid: {
      const EllipsoidMaps maps = ellipsoid_maps(scene.ellipsoids[i]);
      return ellipsoid_area_pdf(maps, normalize(maps.to_local.point(point.position)));
    }
    case PrimitiveKind::Triangle: break;
  }
  const layout::Triangle& t = scene.triangles[i];
  const Vec3d v0 = vec(scene.positions[t.v0]);
  return 2 / length(cross(vec(scene.positions[t.v1]) - v0, vec(scene.positions[t.v2]) - v0));
}

/// A direction into the cone under which a sphere is seen, and the point it meets first.
LightSample sample_sphere_cone(const CompiledScene& scene, std::uint32_t primitive, Vec3d from, Wavelength w, double u1, double u2) {
  const layout::Sphere& s = scene.spheres[primitive_ref(scene, primitive).index];
  const double extent = cone_extent(s, from);
  LightSample sample;
  sample.wi = Frame(normalize(vec(s.center) - from)).to_world(sample_cone(extent, u1, u2));
  Hit hit;
  intersect_primitive(scene, primitive, {from, sample.wi}, 0, hit);
  if (!hit.found()) return {};  // a grazing ray, by rounding
  sample.distance = hit.t;
  sample.primitive = primitive;
  sample.pdf = 1 / (2 * kPi * extent);
  sample.Le = surface_emission(scene, surface_point(scene, primitive, from + sample.wi * hit.t, hit.u, hit.v), -sample.wi, w);
  return sample;
}

LightSample sample_primitive(const CompiledScene& scene, std::uint32_t primitive, Vec3d from, Wavelength w, double u1, double u2) {
  const auto [kind, i] = primitive_ref(scene, primitive);
  if (kind == PrimitiveKind::Sphere && uses_cone(scene.spheres[i], from)) return sample_sphere_cone(scene, primitive, from, w, u1, u2);
  const AreaPoint area = sample_area(scene, primitive, u1, u2);
  const Vec3d to_light = area.position - from;
  LightSample sample;
  sample.distance = length(to_light);
  if (sample.distance == 0) return {};
  sample.wi = to_light / sample.distance;
  sample.primitive = primitive;
  const SurfacePoint point = surface_point(scene, primitive, area.position, area.u, area.v);
  const double cosine = std::abs(dot(sample.wi, point.ng));
  if (cosine == 0) return {};
  sample.pdf = area.pdf * square(sample.distance) / cosine;
  sample.Le = surface_emission(scene, point, -sample.wi, w);
  return sample;
}

}  // namespace

double surface_emission(const CompiledScene& scene, const SurfacePoint& point, Vec3d wo, Wavelength w) {
  if (point.surface->emission == STOKES_NONE || dot(wo, point.ng) <= 0) return 0;
  return color_eval(scene, point.surface->emission, point, wo, w);
}

double escaped_emission(const CompiledScene& scene, Vec3d wi, Wavelength w) {
  double Le = 0;
  if (scene.header.background != STOKES_NONE) Le += spectrum_eval(scene, scene.header.background, w);
  if (scene.header.has_environment) Le += environment_eval(scene, wi, w);
  return Le;
}

Lights::Lights(const CompiledScene& scene) : scene_(scene) {
  double sum = 0;
  for (const layout::Light& light : scene.lights) cumulative_.push_back(sum += light.probability);
}

const layout::Light& Lights::choose(Random& random) const {
  // The probabilities in the tables sum to 1 but for rounding; the last light takes what is left.
  const double u = random.next() * cumulative_.back();
  const auto chosen = std::min<std::size_t>(cumulative_.size() - 1, static_cast<std::size_t>(
                          std::upper_bound(cumulative_.begin(), cumulative_.end(), u) - cumulative_.begin()));
  return scene_.lights[chosen];
}

std::optional<Lights::Place> Lights::sample_place(Random& random) const {
  const layout::Light& light = choose(random);
  const double u1 = random.next(), u2 = random.next();
  if (light.type == layout::LIGHT_BACKGROUND || light.type == layout::LIGHT_ENVIRONMENT) return std::nullopt;
  return Place{sample_area(scene_, light_primitive(scene_, light), u1, u2).position, std::sqrt(light.area)};
}

LightSample Lights::sample(Vec3d from, Wavelength w, Random& random) const {
  const layout::Light& light = choose(random);
  const double u1 = random.next(), u2 = random.next();
  LightSample sample;
  switch (light.type) {
    case layout::LIGHT_BACKGROUND:
      sample.wi = sample_uniform_sphere(u1, u2);
      sample.pdf = 1 / (4 * kPi);
      sample.Le = spectrum_eval(scene_, light.emission, w);
      break;
    case layout::LIGHT_ENVIRONMENT:
      sample.wi = environment_sample(scene_, u1, u2, sample.pdf);
      sample.Le = environment_eval(scene_, sample.wi, w);
      break;
    default: sample = sample_primitive(scene_, light_primitive(scene_, light), from, w, u1, u2);
  }
  sample.pdf *= light.probability;
  return sample;
}

double Lights::pdf(const SurfacePoint& point, Vec3d from) const {
  if (point.light == STOKES_NONE) return 0;
  const double choice = scene_.lights[point.light].probability;
  const auto [kind, i] = primitive_ref(scene_, point.primitive);
  if (kind == PrimitiveKind::Sphere && uses_cone(scene_.spheres[i], from)) return choice / (2 * kPi * cone_extent(scene_.spheres[i], from));
  const Vec3d to_light = point.position - from;
  const double cosine = std::abs(dot(normalize(to_light), point.ng));
  return cosine > 0 ? choice * area_pdf(scene_, point) * length_squared(to_light) / cosine : 0;
}

double Lights::pdf_escaped(Vec3d wi) const {
  double pdf = 0;
  for (const layout::Light& light : scene_.lights) {
    if (light.type == layout::LIGHT_BACKGROUND) pdf += light.probability / (4 * kPi);
    if (light.type == layout::LIGHT_ENVIRONMENT) pdf += light.probability * environment_pdf(scene_, wi);
  }
  return pdf;
}

}  // namespace stokes::reference
