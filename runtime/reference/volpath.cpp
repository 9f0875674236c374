// The main loop. Reads by its comments: fly, maybe scatter in the medium, else meet a surface, add its light, scatter there. Analog
// wherever that is simpler. See volpath.h; the formulas are those of the physics contract (camera paths, radiance carried).
#include "reference/volpath.h"

#include <cmath>
#include <optional>

#include "reference/bsdf.h"
#include "reference/equiangular.h"
#include "reference/fluorescence.h"
#include "reference/medium.h"
#include "reference/phase.h"
#include "reference/sampling.h"

namespace stokes::reference {
namespace {

/// A place where a path scatters: a surface with its BSDF, or a point in a medium with its phase function.
struct Vertex {
  Vec3d position, wo;
  const SurfacePoint* point = nullptr;  ///< null in a medium
  Bsdf bsdf;
  double g = 0;
  std::uint32_t medium = 0;  ///< the medium around a vertex in a medium

  double eval(Vec3d wi) const { return point ? bsdf_eval(bsdf, wo, wi) : phase_hg_eval(g, dot(-wo, wi)); }
  double pdf(Vec3d wi) const { return point ? bsdf_pdf(bsdf, wo, wi) : phase_hg_eval(g, dot(-wo, wi)); }
  std::uint32_t medium_towards(Vec3d wi) const { return point ? point->medium_towards(wi) : medium; }
  std::uint32_t primitive() const { return point ? point->primitive : STOKES_NONE; }
  bool specular() const { return point && is_specular(bsdf); }
};

/// A shadow ray to a hollow light ends short of it by this share of the way: a double's rounding, and far below any chord that is seen.
constexpr double kShortOfLight = 1e-9;

class Path {
 public:
  Path(const World& world, const Ray& ray, Wavelength w, Random& random)
      : world_(world), scene_(world.scene), random_(random), ray_(ray), w_(w), medium_(scene_.header.camera.medium), previous_(ray.o) {}

  PathResult trace() {
    while (step()) {
    }
    return result_;
  }

 private:
  bool step();
  std::optional<Equiangular> equiangular(double t_max);
  void add_airlight(const Equiangular& airlight);
  bool scatter_in_medium(const Flight& flight, const std::optional<Equiangular>& airlight);
  bool scatter_at_surface(const SurfacePoint& point);
  bool begin_vertex();
  void add_direct_light(const Vertex& vertex, double share = 1);
  double shadow_transmittance(const Vertex& vertex, const LightSample& light) const;
  void leave(const Vertex& vertex, Vec3d wi, double weight, double pdf);
  void add_light(double value);
  double emission_weight(double light_pdf) const;
  bool survives_roulette();

  bool next_event() const { return scene_.header.integrator != layout::INTEGRATOR_MATS; }

  const World& world_;
  const CompiledScene& scene_;
  Random& random_;
  Ray ray_;
  Wavelength w_;
  std::uint32_t medium_;
  double beta_ = 1;        // radiance here to radiance at the camera
  double index_scale_ = 1; // what refractions have taken out of beta, for the roulette
  std::uint32_t bounces_ = 0;
  bool fluoresced_ = false;

  // How the present direction came about, for the weight of the light it finds.
  Vec3d previous_;         // the last vertex
  bool by_chance_ = true;  // from the camera or a specular event: no next-event estimation could have found it
  double pdf_ = 0;

  PathResult result_;
};

void Path::add_light(double value) {
  result_.radiance += beta_ * value;
  if (fluoresced_) result_.fluorescent += beta_ * value;
}

/// The weight of light that the path ran into and next-event estimation finds with `light_pdf`.
double Path::emission_weight(double light_pdf) const {
  if (by_chance_) return 1;
  switch (scene_.header.integrator) {
    case layout::INTEGRATOR_NEE: return 0;
    case layout::INTEGRATOR_MIS: return power_heuristic(pdf_, light_pdf);
    default: return 1;
  }
}

bool Path::step() {
  // Fly to the next surface, unless the medium has something to say before it.
  const Hit hit = world_.traversal.closest_hit(ray_);
  const std::optional<Equiangular> airlight = equiangular(hit.t);
  if (airlight) add_airlight(*airlight);
  const Flight flight = medium_flight(scene_, medium_, hit.t, w_, random_);
  beta_ *= flight.weight;
  if (beta_ == 0) return false;
  if (flight.end != Flight::End::Surface) return scatter_in_medium(flight, airlight);

  // Nothing there: the background.
  if (!hit.found()) {
    const double Le = escaped_emission(scene_, ray_.d, w_);
    if (Le > 0) add_light(Le * emission_weight(world_.lights.pdf_escaped(ray_.d)));
    return false;
  }

  // A surface: its own light first.
  const SurfacePoint point = surface_point(scene_, hit.primitive, ray_.o + ray_.d * hit.t, hit.u, hit.v);
  const double Le = surface_emission(scene_, point, -ray_.d, w_);
  if (Le > 0) add_light(Le * emission_weight(world_.lights.pdf(point, previous_)));

  // An index-matched interface is passed straight on: no bounce, and the density stands.
  if (point.surface->flags & SURFACE_INTERFACE) {
    medium_ = point.medium_towards(ray_.d);
    ray_ = {point.position, ray_.d, point.primitive};
    return true;
  }
  return scatter_at_surface(point);
}

/// Counts the scattering event that is about to happen; false where the path must end.
bool Path::begin_vertex() {
  if (bounces_ >= scene_.header.max_bounces) return false;
  bounces_++;
  return true;
}

/// In thin media: towards a light somewhere along the way.
std::optional<Equiangular> Path::equiangular(double t_max) {
  if (!(scene_.media[medium_].flags & MEDIUM_THIN) || bounces_ >= scene_.header.max_bounces) return std::nullopt;
  const auto light = world_.lights.sample_place(random_);
  if (!light) return std::nullopt;
  return Equiangular(ray_, light->position, 0.1 * light->size, t_max);
}

/// The density with which a flight scatters at the distance t.
double collision_pdf(const MediumAt& m, double t) { return m.sigma_t * std::exp(-m.sigma_t * t); }

/// Few flights scatter in a thin medium. So the light that would reach one of them straight from a light is estimated twice, where chance
/// scatters the path (if it does) and here, where scattering towards the light is likely to count, and the two share it by the balance heuristic.
void Path::add_airlight(const Equiangular& airlight) {
  const double t = airlight.sample(random_.next());
  const MediumAt m = medium_at(scene_, medium_, w_);
  Vertex vertex;
  vertex.position = ray_.o + ray_.d * t;
  vertex.wo = -ray_.d;
  vertex.medium = medium_;
  vertex.g = m.g;
  add_direct_light(vertex, m.sigma_s * std::exp(-m.sigma_t * t) / (airlight.pdf(t) + collision_pdf(m, t)));
}

bool Path::scatter_in_medium(const Flight& flight, const std::optional<Equiangular>& airlight) {
  if (!begin_vertex()) return false;
  Vertex vertex;
  vertex.position = ray_.o + ray_.d * flight.t;
  vertex.wo = -ray_.d;
  vertex.medium = medium_;
  // Dyes re-emit into all directions alike.
  if (flight.end == Flight::End::Fluorescence)
    fluoresced_ = true;
  else
    vertex.g = medium_at(scene_, medium_, w_).g;
  w_ = flight.wavelength;

  if (next_event()) {
    const double pdf = collision_pdf(medium_at(scene_, medium_, w_), flight.t);
    add_direct_light(vertex, airlight ? pdf / (pdf + airlight->pdf(flight.t)) : 1);
  }
  const double u1 = random_.next(), u2 = random_.next();
  const Vec3d wi = phase_hg_sample(vertex.g, vertex.wo, u1, u2);
  leave(vertex, wi, 1, vertex.pdf(wi));
  return survives_roulette();
}

bool Path::scatter_at_surface(const SurfacePoint& point) {
  if (!begin_vertex()) return false;
  Vertex vertex;
  vertex.position = point.position;
  vertex.wo = -ray_.d;
  vertex.point = &point;

  // The material: chance chooses among blends, then between reflection and a change of wavelength.
  const layout::Material& material =
      scene_.materials[resolve_blends(scene_, point.surface->material, point, vertex.wo, w_, random_)];
  if (material.type == layout::MATERIAL_FLUORESCENT || material.type == layout::MATERIAL_RERADIATION) {
    const DiffuseBranch branch = diffuse_branch_sample(scene_, material, point, vertex.wo, w_, random_);
    if (branch.weight <= 0) return false;
    beta_ *= branch.weight;
    w_ = branch.wavelength;
    fluoresced_ |= branch.fluoresced;
    vertex.bsdf = lambertian_at(point, vertex.wo, 1);
  } else {
    vertex.bsdf = bsdf_at(scene_, material, point, vertex.wo, w_);
  }

  if (next_event() && !vertex.specular()) add_direct_light(vertex);
  const BsdfSample sample = bsdf_sample(vertex.bsdf, vertex.wo, random_);
  if (sample.weight <= 0) return false;
  index_scale_ *= square(sample.index_ratio);
  leave(vertex, sample.wi, sample.weight, sample.pdf);
  by_chance_ = vertex.specular();
  return survives_roulette();
}

/// Sets out from a vertex.
void Path::leave(const Vertex& vertex, Vec3d wi, double weight, double pdf) {
  beta_ *= weight;
  medium_ = vertex.medium_towards(wi);
  ray_ = {vertex.position, wi, vertex.primitive()};
  previous_ = vertex.position;
  pdf_ = pdf;
  by_chance_ = false;
}

bool Path::survives_roulette() {
  if (bounces_ < scene_.header.russian_roulette) return beta_ > 0;
  const double survival = std::min(1.0, beta_ * index_scale_);
  if (!(random_.next() < survival)) return false;
  beta_ /= survival;
  return true;
}

/// Next-event estimation: one light, one direction towards it, times `share`.
void Path::add_direct_light(const Vertex& vertex, double share) {
  if (world_.lights.empty()) return;
  const LightSample light = world_.lights.sample(vertex.position, w_, random_);
  if (light.pdf <= 0 || light.Le <= 0) return;
  const double value = vertex.eval(light.wi);
  if (value <= 0) return;
  const double weight = scene_.header.integrator == layout::INTEGRATOR_MIS ? power_heuristic(light.pdf, vertex.pdf(light.wi)) : 1;
  add_light(share * value * light.Le * weight / light.pdf * shadow_transmittance(vertex, light));
}

/// What is left of the light on the way: interfaces are passed and change the medium, any other surface blocks.
double Path::shadow_transmittance(const Vertex& vertex, const LightSample& light) const {
  Ray ray = {vertex.position, light.wi, vertex.primitive()};
  std::uint32_t medium = vertex.medium_towards(light.wi);
  double left = light.distance, result = 1;
  // A light's own surface is convex and cannot stand before its own front, unless its front is its inside.
  const bool hollow = is_hollow(scene_, light.primitive);
  for (;;) {
    const Hit hit = hollow ? world_.traversal.closest_hit(ray, left * (1 - kShortOfLight)) : world_.traversal.closest_hit(ray, left, light.primitive);
    if (!hit.found()) return result * transmittance(scene_, medium, left, w_);
    if (!(primitive_surface(scene_, hit.primitive).flags & SURFACE_INTERFACE)) return 0;
    const SurfacePoint point = surface_point(scene_, hit.primitive, ray.o + ray.d * hit.t, hit.u, hit.v);
    result *= transmittance(scene_, medium, hit.t, w_);
    medium = point.medium_towards(ray.d);
    left -= hit.t;
    ray = {point.position, ray.d, point.primitive};
  }
}

}  // namespace

PathResult trace_path(const World& world, const Ray& camera_ray, Wavelength w, Random& random) {
  return Path(world, camera_ray, w, random).trace();
}

}  // namespace stokes::reference
