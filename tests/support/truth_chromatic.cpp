// Cases whose answer depends on the wavelength or the colour channel: chromatic media, dispersion, colours, environment images. They reach
// what grey cases cannot: wavelengths that share a path must each keep their own expectation.
#include <cmath>
#include <numbers>

#include "support/scene_builder.h"
#include "support/truth.h"
#include "support/truth_measure.h"

namespace stokes::tests {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPixels = 16;

SpectrumPtr rgb(Vec3d value) {
  auto s = std::make_shared<Spectrum>();
  s->kind = SpectrumKind::Rgb;
  s->rgb = value;
  return s;
}

/// `low` below 550 nm, `high` above.
SpectrumPtr step(double low, double high) { return sum({box(280, 550, low), box(550, 780, high)}); }

MediumPtr step_medium(Vec3d low, Vec3d high) {
  auto m = std::make_shared<MediumDescription>();
  m->sigma_t = step(low.x, high.x);
  m->albedo = step(low.y, high.y);
  m->g = step(low.z, high.z);
  return m;
}

/// Bins on either side of the step at 550 nm.
void measure_both_sides(TruthCase& c, double low, double high) {
  c.options.spectral_bins = 2;
  c.options.spectral_begin = 450;
  c.options.spectral_end = 650;
  c.measurements = {bins_mean("450-550", c.options, 450, 550, low), bins_mean("550-650", c.options, 550, 650, high)};
}

/// A half space, or a slab of depth 1 over a black floor that may shine.
TruthCase chromatic_layer(const char* name, Vec3d low, Vec3d high, bool slab, bool transmits, double expected_low, double expected_high) {
  TruthCase c;
  c.name = name;
  c.source = "the grey cases' figures, one below and one above 550 nm";
  c.scene = empty_scene(parallel_camera(0, 1, 0.1, kPixels), transmits ? IntegratorKind::Mats : IntegratorKind::Mis, ColorMode::Spectral);
  c.scene.camera.medium = MediumPtr();
  SurfaceDescription top = horizontal_square(0, 2000, interface_material());
  top.inside = step_medium(low, high);
  c.scene.surfaces = {top};
  if (slab) {
    SurfaceDescription bottom = horizontal_square(-1, 2000, interface_material()), floor = horizontal_square(-1.01, 2000, black());
    bottom.flip = true;
    bottom.inside = top.inside;
    if (transmits) floor.emit = constant(1);
    c.scene.surfaces.push_back(bottom);
    c.scene.surfaces.push_back(floor);
  }
  if (!transmits) c.scene.background.emission = constant(1);
  c.samples = 5000;
  measure_both_sides(c, expected_low, expected_high);
  return c;
}

TruthCase dispersive_sheet() {
  TruthCase c;
  c.name = "dispersive_sheet";
  c.source = "closed form: Airy sums of a clear sheet at 70 degrees, n 1.33 below 550 nm and 1.5 above";
  c.scene = empty_scene(parallel_camera(70, 1, 0.1, kPixels), IntegratorKind::Mats, ColorMode::Spectral);
  auto glass = std::make_shared<MaterialDescription>(*dielectric(1));
  glass->ior = step(1.33, 1.5);
  SurfaceDescription top = horizontal_square(0, 2000, glass), bottom = horizontal_square(-1, 2000, glass);
  bottom.flip = true;
  c.scene.surfaces = {top, bottom, horizontal_square(-1.01, 2000, black())};
  c.scene.background.emission = constant(1);
  c.samples = 4000;
  measure_both_sides(c, 0.2342397567, 0.2921201070);
  return c;
}

/// A Lambertian sphere of a colour under a D65 sky of 1.
TruthCase colored_furnace(ColorMode mode) {
  TruthCase c;
  c.name = mode == ColorMode::Rgb ? "colored_furnace_rgb" : "colored_furnace_spectral";
  c.source = "closed form: a convex body in a white furnace shows its colour";
  c.scene = empty_scene(parallel_camera(25, 5, 0.6, kPixels), IntegratorKind::Mis, mode);
  auto material = std::make_shared<MaterialDescription>();
  material->albedo.spectrum = rgb({0.6, 0.4, 0.25});
  c.scene.surfaces = {sphere({}, 1, material)};
  c.scene.background.emission = number(1);
  c.samples = 3000;
  c.measurements = {{"R", {{"R", 1}}, 0.6}, {"G", {{"G", 1}}, 0.4}, {"B", {{"B", 1}}, 0.25}};
  return c;
}

/// Half spaces of three albedos at once.
TruthCase colored_half_space() {
  TruthCase c;
  c.name = "colored_half_space_rgb";
  c.source = "Chandrasekhar 1960, one albedo per channel";
  c.scene = empty_scene(parallel_camera(60, 1, 0.1, kPixels), IntegratorKind::Mis, ColorMode::Rgb);
  c.scene.camera.medium = MediumPtr();
  auto m = std::make_shared<MediumDescription>();
  m->sigma_t = rgb({1, 2, 4});
  m->albedo = rgb({0.5, 0.9, 0.99});
  SurfaceDescription top = horizontal_square(0, 4000, interface_material());
  top.inside = m;
  c.scene.surfaces = {top};
  c.scene.background.emission = number(1);
  c.samples = 2500;
  const truth::HalfSpace* h = truth::kIsotropicHalfSpaces;
  c.measurements = {{"R", {{"R", 1}}, h[0].at_60}, {"G", {{"G", 1}}, h[1].at_60}, {"B", {{"B", 1}}, h[2].at_60}};
  return c;
}

// ---- Environment ------------------------------------------------------------------------------------------------

/// A grey image that is different in every direction, with a bright spot.
std::shared_ptr<ImagePixels> lopsided_image(int width, int height) {
  auto image = std::make_shared<ImagePixels>();
  image->width = width;
  image->height = height;
  for (int row = 0; row < height; row++)
    for (int column = 0; column < width; column++) {
      const double value = row == 2 && column == 5 ? 20 : 0.2 + 0.1 * column + 0.3 * row;
      image->rgb.insert(image->rgb.end(), 3, float(value));
    }
  return image;
}

/// Bilinear lookup at a world direction, as layout.h says where the image lies.
double image_radiance(const ImagePixels& image, Vec3d d, double rotate_degrees) {
  const double a = -rotate_degrees * kPi / 180;
  const Vec3d local = {std::cos(a) * d.x + std::sin(a) * d.z, d.y, -std::sin(a) * d.x + std::cos(a) * d.z};
  const double x = (0.5 + std::atan2(local.x, -local.z) / (2 * kPi)) * image.width - 0.5, y = std::acos(local.y) / kPi * image.height - 0.5;
  const auto at = [&](int column, int row) {
    row = std::clamp(row, 0, image.height - 1);
    column = (column + image.width) % image.width;
    return double(image.rgb[3 * std::size_t(row * image.width + column)]);
  };
  const int c = int(std::floor(x)), r = int(std::floor(y));
  const double fx = x - c, fy = y - r;
  return (1 - fy) * ((1 - fx) * at(c, r) + fx * at(c + 1, r)) + fy * ((1 - fx) * at(c, r + 1) + fx * at(c + 1, r + 1));
}

TruthCase environment(IntegratorKind integrator, ColorMode mode, Vec3d normal) {
  constexpr double kRotate = 40, kScale = 1.5, kAlbedo = 0.5;
  TruthCase c;
  c.name = std::string("environment_") + (integrator == IntegratorKind::Mis ? "mis" : integrator == IntegratorKind::Nee ? "nee" : "mats") +
           (mode == ColorMode::Rgb ? "_rgb_" : "_spectral_") + (normal.z > 0.5 ? "z" : "tilted");
  c.source = "quadrature of the image over the hemisphere, times albedo / pi";
  const Vec3d x = normalize(cross({0, 1, 0}, normal)), y = cross(normal, x);
  CameraDescription camera = parallel_camera(0, 1, 0.01, kPixels);
  camera.transform = frame(x, y, normal, normal);
  c.scene = empty_scene(camera, integrator, mode);
  c.scene.surfaces = {rectangle(frame(x, y, normal, {}), 1, 1, lambertian(kAlbedo))};
  const auto image = lopsided_image(12, 6);
  c.scene.background.environment = image;
  c.scene.background.rotate = kRotate;
  c.scene.background.scale = kScale;
  c.samples = integrator == IntegratorKind::Mats ? 4000 : 2000;

  double irradiance = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; i++)
    for (int j = 0; j < kSteps; j++) {
      // Equal cosine-weighted cells of the hemisphere.
      const double sine = std::sqrt((i + 0.5) / kSteps), phi = 2 * kPi * (j + 0.5) / kSteps;
      const Vec3d d = x * (sine * std::cos(phi)) + y * (sine * std::sin(phi)) + normal * std::sqrt(1 - sine * sine);
      irradiance += image_radiance(*image, d, kRotate) * kPi / kSteps / kSteps;
    }
  c.measurements = {grey(mode, kScale * irradiance * kAlbedo / kPi)};
  return c;
}

}  // namespace

std::vector<TruthCase> chromatic_cases() {
  const Vec3d dense = {2, 0.9, 0.75}, fog = {1, 0.2, 0};
  const Vec3d tilted = normalize(Vec3d{0.5, 0.7, -0.4});
  return {chromatic_layer("chromatic_half_space", {1, 0.5, 0}, {3, 0.9, 0}, false, false, 0.115225878, 0.414947479),
          chromatic_layer("chromatic_slab_R", dense, fog, true, false, 0.0973946, 0.0319835),
          chromatic_layer("chromatic_slab_T", dense, fog, true, true, 0.6609577, 0.3922578),
          dispersive_sheet(),
          colored_furnace(ColorMode::Spectral),
          colored_furnace(ColorMode::Rgb),
          colored_half_space(),
          environment(IntegratorKind::Mis, ColorMode::Spectral, {0, 0, 1}),
          environment(IntegratorKind::Mis, ColorMode::Rgb, tilted),
          environment(IntegratorKind::Nee, ColorMode::Rgb, {0, 0, 1}),
          environment(IntegratorKind::Mats, ColorMode::Rgb, tilted)};
}

}  // namespace stokes::tests
