// Furnaces, enclosures, irradiances and boundaries. See truth_scenes.h.
#include "support/truth_scenes.h"

#include <cmath>
#include <numbers>

#include "support/scene_builder.h"
#include "support/truth.h"
#include "support/truth_measure.h"

namespace stokes::tests {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPixels = 16;

struct Variant {
  IntegratorKind integrator;
  ColorMode mode;
};

constexpr Variant kVariants[] = {{IntegratorKind::Mis, ColorMode::Spectral}, {IntegratorKind::Mats, ColorMode::Spectral},
                                 {IntegratorKind::Nee, ColorMode::Spectral}, {IntegratorKind::Mis, ColorMode::Rgb}};

std::string variant_name(Variant v) {
  const char* integrator = v.integrator == IntegratorKind::Mis ? "mis" : v.integrator == IntegratorKind::Nee ? "nee" : "mats";
  return std::string(integrator) + (v.mode == ColorMode::Rgb ? "_rgb" : "_spectral");
}

SurfaceDescription mesh_surface(std::shared_ptr<const MeshData> mesh, const Affine& transform, MaterialPtr material) {
  SurfaceDescription s;
  s.kind = SurfaceKind::Mesh;
  s.mesh = std::move(mesh);
  s.transform = transform;
  s.material = std::move(material);
  return s;
}

enum class Shape { Sphere, Ellipsoid, Cube };

/// A convex body that fills the view of a camera at (0, 0, 5) on a field of 0.6.
SurfaceDescription convex_body(Shape shape, MaterialPtr material) {
  switch (shape) {
    case Shape::Sphere: break;
    case Shape::Ellipsoid: {
      SurfaceDescription s = sphere({}, 1, std::move(material));
      s.transform = scaling({1.5, 0.8, 0.6});
      return s;
    }
    case Shape::Cube: return mesh_surface(cube_mesh(0.5), {}, std::move(material));
  }
  return sphere({}, 1, std::move(material));
}

TruthCase white_furnace(Shape shape, const char* shape_name, Variant v) {
  TruthCase c;
  c.name = std::string("white_furnace_") + shape_name + "_" + variant_name(v);
  c.source = "closed form: a convex Lambertian body under a uniform sky shows its albedo";
  c.scene = empty_scene(parallel_camera(25, 5, 0.6, kPixels), v.integrator, v.mode);
  c.scene.background.emission = number(1);
  c.scene.surfaces.push_back(convex_body(shape, lambertian(0.8)));
  c.samples = v.integrator == IntegratorKind::Mis ? 512 : 1024;
  c.measurements = {grey(v.mode, 0.8)};
  return c;
}

TruthCase dielectric_furnace(Shape shape, const char* shape_name, double alpha) {
  TruthCase c;
  c.name = std::string("dielectric_furnace_") + shape_name;
  c.source = "closed form: a lossless dielectric in a uniform sky cannot be seen";
  c.scene = empty_scene(parallel_camera(25, 5, 0.6, kPixels), IntegratorKind::Mis, ColorMode::Rgb);
  c.scene.background.emission = number(1);
  auto material = std::make_shared<MaterialDescription>(*dielectric(1.5));
  material->alpha = alpha;
  c.scene.surfaces.push_back(convex_body(shape, material));
  // Colour channels are not drawn by chance, so hardly anything is.
  c.samples = 512;
  c.measurements = {grey(ColorMode::Rgb, 1)};
  return c;
}

TruthCase scattering_furnace(const char* name, Shape shape, MaterialPtr boundary, double g, Variant v) {
  TruthCase c;
  c.name = std::string("scattering_furnace_") + name + "_" + variant_name(v);
  c.source = "closed form: a medium of albedo 1 in a uniform sky cannot be seen";
  c.scene = empty_scene(parallel_camera(25, 5, 0.6, kPixels), v.integrator, v.mode);
  c.scene.background.emission = number(1);
  SurfaceDescription body = convex_body(shape, std::move(boundary));
  body.inside = medium(3, 1, g);
  c.scene.surfaces.push_back(body);
  c.samples = 512;
  c.measurements = {grey(v.mode, 1)};
  return c;
}

/// A sphere seen from its inside, which emits 1 and reflects `albedo`; `bounces` < 0: all of them.
TruthCase enclosure(double albedo, int bounces, Variant v) {
  TruthCase c;
  c.name = "enclosure_" + std::to_string(int(100 * albedo)) + (bounces < 0 ? "" : "_bounces_" + std::to_string(bounces)) + "_" + variant_name(v);
  c.source = "closed form: L = Le / (1 - rho) in any closed surface; the first n bounces are the sum's first n + 1 terms";
  c.scene = empty_scene(parallel_camera(25, 0.2, 0.3, kPixels), v.integrator, v.mode);
  SurfaceDescription wall = sphere({}, 1, lambertian(albedo));
  wall.flip = true;
  wall.emit = number(1);
  c.scene.surfaces.push_back(wall);
  double expected = 1 / (1 - albedo);
  if (bounces >= 0) {
    c.scene.integrator.max_bounces = bounces;
    c.scene.integrator.russian_roulette.reset();
    expected = (1 - std::pow(albedo, bounces + 1)) / (1 - albedo);
  }
  c.samples = 512;
  c.measurements = {grey(v.mode, expected)};
  return c;
}

/// A Lambertian floor of albedo 0.5 under one light of radiance 1; the film sees a dot of it, from the side.
TruthCase irradiance(const std::string& name, SurfaceDescription light, double expected, Variant v) {
  TruthCase c;
  c.name = "irradiance_" + name + "_" + variant_name(v);
  c.source = "closed form (configuration factors): L = albedo / pi times the irradiance";
  c.scene = empty_scene(parallel_camera(60, 0.5, 1e-3, kPixels), v.integrator, v.mode);
  c.scene.surfaces.push_back(horizontal_square(0, 0.1, lambertian(0.5)));
  light.emit = number(1);
  c.scene.surfaces.push_back(std::move(light));
  c.samples = v.integrator == IntegratorKind::Mats ? 8192 : 1024;
  c.measurements = {grey(v.mode, expected * 0.5 / kPi)};
  return c;
}

SurfaceDescription flipped(SurfaceDescription s) {
  s.flip = !s.flip;
  return s;
}

/// Facing down at the height z.
Affine facing_down(double z) { return frame({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, z}); }

SurfaceDescription square_of_triangles(double z, double side) {
  auto mesh = std::make_shared<MeshData>();
  const double h = side / 2;
  mesh->positions = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh_surface(mesh, facing_down(z), black());
}

/// The sphere's irradiance from an ellipsoid's code: a sphere scaled to a hair's breadth from round.
SurfaceDescription nearly_round(Vec3d center, double radius) {
  SurfaceDescription s = sphere({}, 1, black());
  s.transform = translation(center) * scaling({radius * 1.00001, radius, radius});
  return s;
}

}  // namespace

std::vector<TruthCase> furnace_cases() {
  std::vector<TruthCase> cases;
  for (const Variant v : kVariants) cases.push_back(white_furnace(Shape::Sphere, "sphere", v));
  cases.push_back(white_furnace(Shape::Ellipsoid, "ellipsoid", kVariants[0]));
  cases.push_back(white_furnace(Shape::Cube, "cube", kVariants[0]));
  cases.push_back(dielectric_furnace(Shape::Sphere, "sphere", 0));
  cases.push_back(dielectric_furnace(Shape::Ellipsoid, "ellipsoid", 0));
  cases.push_back(dielectric_furnace(Shape::Cube, "cube", 0));
  for (const Variant v : {kVariants[0], kVariants[1], kVariants[3]}) {
    cases.push_back(scattering_furnace("matched_g0", Shape::Sphere, interface_material(), 0, v));
    cases.push_back(scattering_furnace("matched_g09", Shape::Cube, interface_material(), 0.9, v));
    cases.push_back(scattering_furnace("n15_g05", Shape::Ellipsoid, dielectric(1.5), 0.5, v));
  }
  for (const Variant v : kVariants) cases.push_back(enclosure(0.5, -1, v));
  cases.push_back(enclosure(0.8, -1, kVariants[0]));
  for (const int bounces : {0, 1, 3}) cases.push_back(enclosure(0.8, bounces, kVariants[0]));
  cases.push_back(enclosure(0.8, 2, kVariants[2]));
  return cases;
}

std::vector<TruthCase> irradiance_cases() {
  const Vec3d overhead = {0, 0, 2}, tilted = {std::sqrt(2.0), 0, std::sqrt(2.0)};
  std::vector<TruthCase> cases;
  for (const Variant v : kVariants) {
    cases.push_back(irradiance("square", rectangle(facing_down(1), 1, 1, black()), truth::kUnderSquare, v));
    cases.push_back(irradiance("triangles", square_of_triangles(1, 1), truth::kUnderSquare, v));
    cases.push_back(irradiance("sphere", sphere(overhead, 0.5, black()), truth::kFromSphere, v));
  }
  cases.push_back(irradiance("rectangle", rectangle(facing_down(0.7), 2, 0.4, black()), truth::kUnderRectangle, kVariants[0]));
  cases.push_back(irradiance("tilted_sphere", sphere(tilted, 0.5, black()), truth::kFromTiltedSphere, kVariants[0]));
  cases.push_back(irradiance("ellipsoid", nearly_round(overhead, 0.5), truth::kFromSphere, kVariants[0]));
  cases.push_back(irradiance("ellipsoid", nearly_round(tilted, 0.5), truth::kFromTiltedSphere, kVariants[2]));
  // Whose front is its inside: an opaque one hides its light, an interface shows the far half through the near one.
  cases.push_back(irradiance("hollow_sphere", flipped(sphere(overhead, 0.5, black())), 0, kVariants[0]));
  cases.push_back(irradiance("hollow_sphere_interface", flipped(sphere(overhead, 0.5, interface_material())), truth::kFromSphere, kVariants[0]));
  cases.push_back(irradiance("hollow_ellipsoid", flipped(nearly_round(overhead, 0.5)), 0, kVariants[2]));
  return cases;
}

}  // namespace stokes::tests
