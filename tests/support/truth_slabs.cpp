// Plane layers: slabs, half spaces, clear sheets, coated Lambertians. A layer's reflectance at an angle needs no special sensor: under a
// uniform sky of radiance 1 over a black floor, seen along that angle, the pixel is R by reciprocity. With the floor shining instead of
// the sky it is T.
#include <cstdio>

#include "support/scene_builder.h"
#include "support/truth.h"
#include "support/truth_measure.h"

namespace stokes::tests {
namespace {

constexpr int kPixels = 16;
enum class Quantity { Reflectance, Transmittance };

std::string decimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  for (char& c : text)
    if (c == '.' || c == '-') c = '_';
  return text;
}

/// Two horizontal squares with a medium between, or one over an endless medium (depth 0); wide against everything that happens within.
SceneDescription layer(double width, double depth, MaterialPtr boundary, MediumPtr filling, double degrees, Quantity quantity,
                       IntegratorKind integrator, ColorMode mode) {
  const double thickness = depth > 0 ? depth : width / 2000;
  SceneDescription scene = empty_scene(parallel_camera(degrees, thickness, width / 1e4, kPixels), integrator, mode);
  scene.camera.medium = MediumPtr();
  SurfaceDescription top = horizontal_square(0, width, boundary);
  top.inside = filling;
  scene.surfaces.push_back(top);
  if (depth > 0) {
    // Its normal points down, out of the layer: indices of refraction are inside over outside.
    SurfaceDescription bottom = horizontal_square(-depth, width, boundary);
    bottom.flip = true;
    bottom.inside = filling;
    scene.surfaces.push_back(bottom);
    SurfaceDescription floor = horizontal_square(-depth * 1.01, width, black());
    if (quantity == Quantity::Transmittance) floor.emit = number(1);
    scene.surfaces.push_back(floor);
  }
  if (quantity == Quantity::Reflectance) scene.background.emission = number(1);
  return scene;
}

TruthCase slab(const truth::Slab& s, Quantity quantity, ColorMode mode, int samples) {
  const bool reflects = quantity == Quantity::Reflectance, matched = s.ior == 1;
  TruthCase c;
  c.name = std::string("slab_") + s.name + (reflects ? "_R" : "_T") + (mode == ColorMode::Rgb ? "_rgb" : "_spectral");
  for (char& letter : c.name)
    if (letter == '.') letter = '_';
  c.source = s.source;
  // Next-event estimation finds nothing through a refracting boundary.
  c.scene = layer(2000 / s.sigma_t, s.depth, matched ? interface_material() : dielectric(s.ior), medium(s.sigma_t, s.albedo, s.g), 0, quantity,
                  matched && reflects ? IntegratorKind::Mis : IntegratorKind::Mats, mode);
  c.samples = samples;
  c.measurements = {grey(mode, reflects ? s.reflectance : s.transmittance)};
  return c;
}

TruthCase half_space(double albedo, double degrees, double expected) {
  TruthCase c;
  c.name = "half_space_" + decimal(albedo) + "_at_" + decimal(degrees);
  c.source = "Chandrasekhar 1960: R = 1 - H(mu) sqrt(1 - albedo)";
  c.scene = layer(2000, 0, interface_material(), medium(1, albedo, 0), degrees, Quantity::Reflectance, IntegratorKind::Mis, ColorMode::Rgb);
  c.samples = 600;
  c.measurements = {grey(ColorMode::Rgb, expected)};
  return c;
}

TruthCase sheet(const truth::Sheet& s, Quantity quantity) {
  const bool reflects = quantity == Quantity::Reflectance;
  TruthCase c;
  c.name = "sheet_n" + decimal(s.n) + "_a" + decimal(s.mu_a_d) + "_at_" + decimal(s.degrees) + (reflects ? "_R" : "_T");
  c.source = "closed form: Airy sums of a clear absorbing sheet, scalar Fresnel factors";
  c.scene = layer(2000, 1, dielectric(s.n), s.mu_a_d > 0 ? medium(s.mu_a_d, 0, 0) : nullptr, s.degrees, quantity, IntegratorKind::Mats,
                  ColorMode::Rgb);
  c.samples = reflects ? 8000 : 3000;
  c.measurements = {grey(ColorMode::Rgb, reflects ? s.reflectance : s.transmittance)};
  return c;
}

TruthCase coated(const truth::CoatedLambertian& t, ColorMode mode) {
  TruthCase c;
  c.name = "coated_n" + decimal(t.n) + "_rho" + decimal(t.rho) + "_at_" + decimal(t.degrees) + (mode == ColorMode::Rgb ? "_rgb" : "_spectral");
  c.source = "closed form: Rs + (1 - Rs)(1 - Ri) rho / (1 - rho Ri)";
  c.scene = empty_scene(parallel_camera(t.degrees, 1, 0.1, kPixels), IntegratorKind::Mis, mode);
  c.scene.surfaces = {horizontal_square(0, 4000, dielectric(t.n)), horizontal_square(-1, 4000, lambertian(t.rho))};
  c.scene.background.emission = number(1);
  c.samples = 2000;
  c.measurements = {grey(mode, t.reflectance)};
  return c;
}

/// A shining floor under a refracting surface: radiance falls by n^2 on the way out. (Paths that enter and leave again cannot tell.)
TruthCase sunken_light(double n, double degrees, double fresnel) {
  TruthCase c;
  c.name = "sunken_light_n" + decimal(n) + "_at_" + decimal(degrees);
  c.source = "closed form: (1 - Rs) Le / n^2";
  c.scene = empty_scene(parallel_camera(degrees, 1, 0.1, kPixels), IntegratorKind::Mis, ColorMode::Rgb);
  SurfaceDescription floor = horizontal_square(-1, 4000, black());
  floor.emit = number(1);
  c.scene.surfaces = {horizontal_square(0, 4000, dielectric(n)), floor};
  c.samples = 1000;
  c.measurements = {grey(ColorMode::Rgb, (1 - fresnel) / (n * n))};
  return c;
}

}  // namespace

std::vector<TruthCase> slab_cases() {
  std::vector<TruthCase> cases;
  for (const truth::Slab& s : truth::kSlabs) {
    cases.push_back(slab(s, Quantity::Reflectance, ColorMode::Rgb, 3000));
    if (s.depth > 0) cases.push_back(slab(s, Quantity::Transmittance, ColorMode::Rgb, 2000));
  }
  cases.push_back(slab(truth::kSlabs[0], Quantity::Reflectance, ColorMode::Spectral, 4000));
  cases.push_back(slab(truth::kSlabs[0], Quantity::Transmittance, ColorMode::Spectral, 2000));
  for (const truth::HalfSpace& h : truth::kIsotropicHalfSpaces) {
    cases.push_back(half_space(h.albedo, 0, h.at_0));
    cases.push_back(half_space(h.albedo, 60, h.at_60));
    cases.push_back(half_space(h.albedo, 75, h.at_75));
  }
  return cases;
}

std::vector<TruthCase> boundary_cases() {
  std::vector<TruthCase> cases;
  for (const truth::Sheet& s : truth::kSheets) {
    cases.push_back(sheet(s, Quantity::Reflectance));
    cases.push_back(sheet(s, Quantity::Transmittance));
  }
  for (const truth::CoatedLambertian& t : truth::kCoatedLambertians) cases.push_back(coated(t, ColorMode::Rgb));
  cases.push_back(coated(truth::kCoatedLambertians[3], ColorMode::Spectral));
  cases.push_back(sunken_light(1.5, 0, 0.04));
  cases.push_back(sunken_light(1.33, 60, 0.0591255992));
  return cases;
}

}  // namespace stokes::tests
