// Light that a fog scatters once on its way from small lamps: one integral over the line of sight, done here by a sum over its points and over
// the lamps seen from each. Knows nothing of how integrators choose distances.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support/scene_builder.h"
#include "support/truth_measure.h"

namespace stokes::tests {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPixels = 16;
// The line of sight: from kEye downwards. The lamps' distances from it are small against the fog's mean free path.
constexpr Vec3d kEye = {0.3, 0, 2}, kDown = {0, 0, -1};

struct Fog {
  double sigma_t, albedo, g;
};

double phase(double g, double cosine) { return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5)); }

/// Calls visit(direction, distance, solid angle) for the cells of a lamp of radiance 1 as seen from x.
using Visit = std::function<void(Vec3d, double, double)>;
using Lamp = std::function<void(Vec3d, const Visit&)>;

Lamp sphere_lamp(Vec3d center, double radius) {
  return [=](Vec3d x, const Visit& visit) {
    constexpr int kRings = 24, kSectors = 24;
    const double distance = length(center - x), extent = 1 - std::sqrt(1 - radius * radius / (distance * distance));
    const Vec3d axis = (center - x) / distance, side = normalize(cross(axis, std::abs(axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})), up = cross(axis, side);
    for (int i = 0; i < kRings; i++)
      for (int j = 0; j < kSectors; j++) {
        const double cosine = 1 - extent * (i + 0.5) / kRings, sine2 = 1 - cosine * cosine, phi = 2 * kPi * (j + 0.5) / kSectors;
        const Vec3d d = axis * cosine + (side * std::cos(phi) + up * std::sin(phi)) * std::sqrt(sine2);
        visit(d, distance * cosine - std::sqrt(radius * radius - distance * distance * sine2), 2 * kPi * extent / (kRings * kSectors));
      }
  };
}

/// Shines towards cross(x, y).
Lamp square_lamp(Vec3d center, Vec3d x_axis, Vec3d y_axis, double side) {
  return [=](Vec3d x, const Visit& visit) {
    constexpr int kCells = 24;
    for (int i = 0; i < kCells; i++)
      for (int j = 0; j < kCells; j++) {
        const Vec3d to = center + x_axis * (side * ((i + 0.5) / kCells - 0.5)) + y_axis * (side * ((j + 0.5) / kCells - 0.5)) - x;
        const double distance = length(to), cosine = -dot(to, cross(x_axis, y_axis)) / distance;
        if (cosine > 0) visit(to / distance, distance, side * side / (kCells * kCells) * cosine / (distance * distance));
      }
  };
}

/// The integral from t0 to t1 of what is scattered into the line of sight. `sky` is the radiance from beyond the fog, if any, which ends
/// at `exit` from a point along a direction; the lamps stand before it.
double airlight(Fog fog, const std::vector<Lamp>& lamps, double t0, double t1, double sky = 0, const std::function<double(Vec3d, Vec3d)>& exit = {}) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; i++) {
    const double t = t0 + (t1 - t0) * (i + 0.5) / kSteps;
    const Vec3d x = kEye + kDown * t;
    double light = 0;
    for (const Lamp& lamp : lamps)
      lamp(x, [&](Vec3d d, double distance, double solid_angle) {
        const double hidden = exit ? sky * std::exp(-fog.sigma_t * exit(x, d)) : 0;
        light += phase(fog.g, dot(kDown, d)) * solid_angle * (std::exp(-fog.sigma_t * distance) - hidden);
      });
    for (int cell = 0; exit && cell < 48 * 48; cell++) {
      const double cosine = 2 * (cell / 48 + 0.5) / 48 - 1, sine = std::sqrt(1 - cosine * cosine), phi = 2 * kPi * (cell % 48 + 0.5) / 48;
      const Vec3d d = {sine * std::cos(phi), sine * std::sin(phi), cosine};
      light += phase(fog.g, dot(kDown, d)) * 4 * kPi / (48 * 48) * sky * std::exp(-fog.sigma_t * exit(x, d));
    }
    sum += fog.sigma_t * fog.albedo * std::exp(-fog.sigma_t * (t - t0)) * light * (t1 - t0) / kSteps;
  }
  return sum;
}

MediumPtr fog_medium(Fog fog) { return medium(fog.sigma_t, fog.albedo, fog.g); }

/// `low` below 550 nm, `high` above.
MediumPtr step_fog(Fog low, Fog high) {
  const auto step = [](double a, double b) { return sum({box(280, 550, a), box(550, 780, b)}); };
  auto m = std::make_shared<MediumDescription>();
  m->sigma_t = step(low.sigma_t, high.sigma_t);
  m->albedo = step(low.albedo, high.albedo);
  m->g = step(low.g, high.g);
  return m;
}

// ---- Scenes -----------------------------------------------------------------------------------------------------

constexpr double kRadius = 0.05, kSide = 0.1;
constexpr Vec3d kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

enum class Shape { Sphere, Ellipsoid, Square, Mesh };

/// At the origin; the flat ones face the line of sight.
SurfaceDescription lamp_surface(Shape shape) {
  SurfaceDescription s;
  switch (shape) {
    case Shape::Sphere: s = sphere({}, kRadius, black()); break;
    case Shape::Ellipsoid:
      s = sphere({}, 1, black());
      s.transform = scaling({kRadius * 1.00001, kRadius, kRadius});
      break;
    case Shape::Square: s = rectangle(frame(kY, kZ, kX, {}), kSide, kSide, black()); break;
    case Shape::Mesh: {
      auto mesh = std::make_shared<MeshData>();
      const double h = kSide / 2;
      mesh->positions = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
      mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
      s.kind = SurfaceKind::Mesh;
      s.mesh = mesh;
      s.transform = frame(kY, kZ, kX, {});
      s.material = black();
      break;
    }
  }
  return s;
}

Lamp lamp_of(Shape shape) {
  const bool round = shape == Shape::Sphere || shape == Shape::Ellipsoid;
  return round ? sphere_lamp({}, kRadius) : square_lamp({}, kY, kZ, kSide);
}

/// A view along the line of sight, at what was scattered once.
TruthCase looking_through(const std::string& name, IntegratorKind integrator, ColorMode mode, int samples) {
  TruthCase c;
  c.name = "airlight_" + name;
  c.source = "the airlight integral of single scattering, summed over the line of sight and the lamps";
  c.scene = empty_scene(parallel_camera(0, kEye.z, 1e-3, kPixels, {kEye.x, 0, 0}), integrator, mode);
  c.scene.integrator.max_bounces = 1;
  c.samples = samples;
  return c;
}

/// One lamp, and fog everywhere.
TruthCase endless(const std::string& name, Shape shape, MediumPtr fog, IntegratorKind integrator, ColorMode mode, int samples) {
  TruthCase c = looking_through(name, integrator, mode, samples);
  SurfaceDescription lamp = lamp_surface(shape);
  lamp.emit = mode == ColorMode::Rgb ? number(1) : constant(1);
  lamp.outside = fog;
  c.scene.camera.medium = fog;
  c.scene.surfaces = {lamp};
  return c;
}

TruthCase grey_fog(const std::string& name, Shape shape, Fog fog, IntegratorKind integrator) {
  TruthCase c = endless(name, shape, fog_medium(fog), integrator, ColorMode::Rgb, 512);
  c.measurements = {grey(ColorMode::Rgb, airlight(fog, {lamp_of(shape)}, 0, 100))};
  return c;
}

/// A black wall behind the lamp ends the line of sight.
TruthCase before_a_wall(Fog fog) {
  TruthCase c = endless("before_a_wall", Shape::Sphere, fog_medium(fog), IntegratorKind::Mis, ColorMode::Rgb, 512);
  SurfaceDescription wall = horizontal_square(-0.2, 20, black());
  wall.outside = c.scene.surfaces[0].outside;
  c.scene.surfaces.push_back(wall);
  c.measurements = {grey(ColorMode::Rgb, airlight(fog, {lamp_of(Shape::Sphere)}, 0, kEye.z + 0.2))};
  return c;
}

TruthCase chromatic(const std::string& name, Fog low, Fog high) {
  TruthCase c = endless(name, Shape::Sphere, step_fog(low, high), IntegratorKind::Mis, ColorMode::Spectral, 2048);
  c.options.spectral_bins = 2;
  c.options.spectral_begin = 450;
  c.options.spectral_end = 650;
  const auto expected = [](Fog fog) { return airlight(fog, {lamp_of(Shape::Sphere)}, 0, 100); };
  c.measurements = {bins_mean("450-550", c.options, 450, 550, expected(low)), bins_mean("550-650", c.options, 550, 650, expected(high))};
  return c;
}

/// A ball of fog in the void with two lamps in it, under a sky.
TruthCase ball(Fog fog, ColorMode mode) {
  constexpr double kSky = 0.003;
  constexpr Vec3d kSecond = {0.3, -0.4, 0.2};
  TruthCase c = looking_through(mode == ColorMode::Rgb ? "ball_rgb" : "ball_spectral", IntegratorKind::Mis, mode, 1024);
  SurfaceDescription round = lamp_surface(Shape::Sphere), flat = rectangle(frame(kZ, kX, kY, kSecond), kSide, kSide, black());
  SurfaceDescription boundary = sphere({}, 1, interface_material());
  round.outside = flat.outside = flat.inside = boundary.inside = fog_medium(fog);
  round.emit = flat.emit = number(1);
  c.scene.surfaces = {round, flat, boundary};
  c.scene.background.emission = number(kSky);
  const auto exit = [](Vec3d x, Vec3d d) { return -dot(x, d) + std::sqrt(dot(x, d) * dot(x, d) + 1 - dot(x, x)); };
  const double half = std::sqrt(1 - kEye.x * kEye.x);
  const double scattered = airlight(fog, {sphere_lamp({}, kRadius), square_lamp(kSecond, kZ, kX, kSide)}, kEye.z - half, kEye.z + half, kSky, exit);
  c.measurements = {grey(mode, scattered + kSky * std::exp(-fog.sigma_t * 2 * half))};
  return c;
}

}  // namespace

std::vector<TruthCase> airlight_cases() {
  const Fog thin = {0.1, 0.9, 0}, forward = {0.2, 0.8, 0.6}, clear = {0, 0, 0};
  return {grey_fog("sphere", Shape::Sphere, thin, IntegratorKind::Mis),
          grey_fog("ellipsoid", Shape::Ellipsoid, thin, IntegratorKind::Mis),
          grey_fog("square", Shape::Square, thin, IntegratorKind::Mis),
          grey_fog("mesh", Shape::Mesh, thin, IntegratorKind::Mis),
          grey_fog("sphere_nee", Shape::Sphere, thin, IntegratorKind::Nee),
          grey_fog("forward", Shape::Sphere, forward, IntegratorKind::Mis),
          before_a_wall(forward),
          chromatic("chromatic", {0.05, 0.9, 0}, {0.4, 0.5, 0.6}),
          chromatic("clear_below_550", clear, forward),
          ball({0.5, 0.7, 0.3}, ColorMode::Rgb),
          ball({0.5, 0.7, 0.3}, ColorMode::Spectral)};
}

}  // namespace stokes::tests
