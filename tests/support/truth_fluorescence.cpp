// Fluorescent surfaces and media with closed forms: a flat patch, two plates, a closed cavity with a cascade of dyes, a measured matrix, a
// dye in a slab. All light that excites lies in bands apart from what the dyes emit, unless the case is about overlap.
#include <cmath>
#include <numbers>

#include "support/scene_builder.h"
#include "support/truth.h"
#include "support/truth_measure.h"

namespace stokes::tests {

Measurement bins_mean(const std::string& label, const CompileOptions& options, double begin, double end, double expected) {
  const double width = (options.spectral_end - options.spectral_begin) / options.spectral_bins;
  const int first = int(std::lround((begin - options.spectral_begin) / width)), last = int(std::lround((end - options.spectral_begin) / width));
  Measurement m{label, {}, expected};
  for (int i = first; i < last; i++)
    m.channels.emplace_back(spectral_channel_name(options.spectral_begin + (i + 0.5) * width), 1.0 / (last - first));
  return m;
}

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPixels = 16;

const char* integrator_name(IntegratorKind k) { return k == IntegratorKind::Mis ? "mis" : k == IntegratorKind::Nee ? "nee" : "mats"; }

CompileOptions bins(double begin, double end, int count) {
  CompileOptions o;
  o.spectral_bins = count;
  o.spectral_begin = begin;
  o.spectral_end = end;
  return o;
}

DyeDescription dye(SpectrumPtr absorption, SpectrumPtr emission, double concentration, double yield, bool photon_yield) {
  DyeDescription d;
  d.absorption = std::move(absorption);
  d.emission = std::move(emission);
  d.concentration = concentration;
  d.yield = yield;
  d.photon_yield = photon_yield;
  return d;
}

MaterialPtr fluorescent(double albedo, std::vector<DyeDescription> dyes) {
  auto m = std::make_shared<MaterialDescription>();
  m->kind = MaterialKind::DiffuseFluorescent;
  m->albedo.spectrum = number(albedo);
  m->dyes = std::move(dyes);
  return m;
}

/// A patch under a sky of the given radiance, seen at 30 degrees.
SceneDescription patch_scene(MaterialPtr material, SpectrumPtr sky, IntegratorKind integrator) {
  SceneDescription scene = empty_scene(parallel_camera(30, 1, 0.01, kPixels), integrator, ColorMode::Spectral);
  scene.surfaces.push_back(horizontal_square(0, 1, std::move(material)));
  scene.background.emission = std::move(sky);
  return scene;
}

TruthCase flat_patch(const truth::FlatPatch& t, int index, IntegratorKind integrator) {
  TruthCase c;
  c.name = "fluorescent_patch_" + std::to_string(index) + "_" + integrator_name(integrator);
  c.source = "closed form: L(lo) = c Q e(lo) int a E [li / lo] dli / pi";
  c.scene = patch_scene(fluorescent(t.albedo, {dye(box(340, 420, 1), box(480, 560, 1), t.concentration, t.yield, t.photon_yield)}),
                        box(350, 400, 2 / kPi), integrator);
  c.options = bins(340, 560, 22);
  c.options.film_channels = FILM_FLUORESCENCE;
  c.samples = 4000;
  // Inside the band the radiance falls as 1 / lo for a photon yield, and is flat for an energy yield.
  const auto shape = [&](double begin, double end) {
    return t.photon_yield ? std::log(end / begin) / std::log(560.0 / 480.0) / (end - begin) : 1.0 / 80;
  };
  c.measurements = {bins_mean("480-520", c.options, 480, 520, t.emitted_480_560 * shape(480, 520)),
                    bins_mean("520-560", c.options, 520, 560, t.emitted_480_560 * shape(520, 560)),
                    bins_mean("350-400", c.options, 350, 400, t.reflected_350_400),
                    bins_mean("420-480", c.options, 420, 480, 0),
                    {"energy", {{"Fluorescence.Energy", 1}}, t.emitted_480_560}};
  return c;
}

/// Absorption and emission over the same band; the mask keeps li <= lo.
TruthCase stokes_masked_patch(IntegratorKind integrator) {
  const double concentration = 0.6, yield = 0.8, albedo = 0.5;
  TruthCase c;
  c.name = std::string("fluorescent_patch_stokes_") + integrator_name(integrator);
  c.source = "closed form: a sky of radiance 1 from 400 to 600 nm; L(lo) = (1 - c) r + c Q (lo - 400) / 200";
  DyeDescription d = dye(box(400, 600, 1), box(400, 600, 1), concentration, yield, false);
  d.stokes = true;
  c.scene = patch_scene(fluorescent(albedo, {d}), box(400, 600, 1), integrator);
  c.options = bins(400, 600, 2);
  c.samples = 2000;
  const double reflected = (1 - concentration) * albedo;
  c.measurements = {bins_mean("400-500", c.options, 400, 500, reflected + concentration * yield * 0.25),
                    bins_mean("500-600", c.options, 500, 600, reflected + concentration * yield * 0.75)};
  return c;
}

/// A matrix that grows linearly with li, and with lo over its band.
TruthCase measured_patch(IntegratorKind integrator) {
  auto matrix = std::make_shared<ReradiationMatrix>();
  for (int i = 0; i <= 10; i++) matrix->li.push_back(300 + 10 * i), matrix->lo.push_back(450 + 10 * i);
  for (int row = 0; row <= 10; row++)
    for (int column = 0; column <= 10; column++) matrix->values.push_back(0.1 * (column / 10.0) * (row / 10.0));
  auto material = std::make_shared<MaterialDescription>();
  material->kind = MaterialKind::Reradiation;
  material->matrix = matrix;
  TruthCase c;
  c.name = std::string("measured_patch_") + integrator_name(integrator);
  c.source = "closed form: K = 0.01 / nm (li - 300) / 100 (lo - 450) / 100 under a sky of radiance 1 from 320 to 380 nm";
  c.scene = patch_scene(material, box(320, 380, 1), integrator);
  c.options = bins(400, 600, 8);
  c.samples = 4000;
  const double excited = 0.01 * 60 * 0.5;
  c.measurements = {bins_mean("450-500", c.options, 450, 500, excited * 0.25), bins_mean("500-550", c.options, 500, 550, excited * 0.75),
                    bins_mean("400-450", c.options, 400, 450, 0), bins_mean("550-600", c.options, 550, 600, 0)};
  return c;
}

/// What the beam excites on plate A is A's emission here; all further exchange is the integrator's.
TruthCase plates(const truth::Plates& t, bool look_at_a, IntegratorKind integrator) {
  TruthCase c;
  c.name = std::string("fluorescent_plates_r") + std::to_string(int(10 * t.r)) + (look_at_a ? "_A_" : "_B_") + integrator_name(integrator);
  c.source = "closed form: exchange between two infinite plates";
  c.scene = empty_scene(parallel_camera(look_at_a ? 30 : 150, 0.25, 0.01, kPixels, {0, 0, look_at_a ? 0.0 : 1.0}), integrator, ColorMode::Spectral);
  SurfaceDescription a = horizontal_square(0, 2000, fluorescent(t.r, {dye(box(300, 400, 1), box(400, 500, 1), t.c, t.yield_a, false)}));
  a.emit = sum({box(300, 400, t.r * (1 - t.c) / kPi), box(400, 500, t.c * t.yield_a / kPi)});
  SurfaceDescription b = rectangle(frame({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}), 2000, 2000,
                                   fluorescent(t.r, {dye(box(400, 500, 1), box(500, 600, 1), t.c, t.yield_b, false)}));
  c.scene.surfaces = {a, b};
  c.options = bins(300, 600, 3);
  c.samples = 3000;
  const double* L = look_at_a ? t.radiance_a : t.radiance_b;
  for (int band = 0; band < 3; band++) {
    const double begin = 300 + 100 * band;
    c.measurements.push_back(bins_mean(std::to_string(int(begin)), c.options, begin, begin + 100, L[band]));
  }
  return c;
}

/// A cavity whose wall shines at 300-400 nm and holds two dyes; the second lives on the first's emission.
TruthCase cascade(IntegratorKind integrator) {
  const double r = 0.5, c1 = 0.6, q1 = 0.9, c2 = 0.4, q2 = 0.8;
  TruthCase c;
  c.name = std::string("fluorescent_cavity_") + integrator_name(integrator);
  c.source = "closed form: L = source / (1 - reflected part) at each wavelength of a closed cavity; photon yields";
  c.scene = empty_scene(parallel_camera(25, 0.2, 0.3, kPixels), integrator, ColorMode::Spectral);
  SurfaceDescription wall = sphere({}, 1, fluorescent(r, {dye(box(300, 400, 1), box(450, 550, 1), c1, q1, true),
                                                          dye(box(450, 550, 1), box(600, 700, 1), c2, q2, true)}));
  wall.flip = true;
  wall.emit = box(300, 400, 1);
  c.scene.surfaces = {wall};
  c.options = bins(300, 700, 8);
  c.samples = 4000;
  // Excitation is counted in photons: int L li dli.
  const double exciting = 1 / (1 - (1 - c1) * r), photons = exciting * 0.5 * (400.0 * 400 - 300.0 * 300);
  const double first = c1 * q1 * photons * (std::log(550.0 / 450) / 100) / 100 / (1 - (1 - c2) * r);
  const double photons_second = c1 * q1 * photons / (1 - (1 - c2) * r);
  const double second = c2 * q2 * photons_second * (std::log(700.0 / 600) / 100) / 100 / (1 - r);
  c.measurements = {bins_mean("300-400", c.options, 300, 400, exciting), bins_mean("450-550", c.options, 450, 550, first),
                    bins_mean("600-700", c.options, 600, 700, second), bins_mean("550-600", c.options, 550, 600, 0)};
  return c;
}

/// The exponential integral E2(x) = int_0^1 exp(-x / t) dt, by the midpoint rule.
double exponential_integral_2(double x) {
  const int steps = 2000;
  double sum = 0;
  for (int i = 0; i < steps; i++) sum += std::exp(-x * steps / (i + 0.5));
  return sum / steps;
}

/// A slab of dyed medium, index-matched, over a black floor under an ultraviolet sky. The light that excites at the depth z is
/// 2 pi L0 E2(sigma z); what comes back is attenuated once more.
TruthCase dyed_slab(double dye_sigma, double base_sigma, double degrees, IntegratorKind integrator) {
  const double depth = 1.5, yield = 0.7, band = 50;
  TruthCase c;
  c.name = std::string("dyed_slab_") + (base_sigma > 0 ? "absorbing_" : "clear_") + std::to_string(int(degrees)) + "_" + integrator_name(integrator);
  c.source = "closed form: int of the source sigma_a Q e E2(sigma z) / 2 along the ray, attenuated";
  c.scene = empty_scene(parallel_camera(degrees, 1, 0.1, kPixels), integrator, ColorMode::Spectral);
  c.scene.camera.medium = MediumPtr();
  auto m = std::make_shared<MediumDescription>();
  m->sigma_s = number(0);
  m->sigma_a = number(base_sigma);
  m->dyes = {dye(box(350, 400, dye_sigma), box(500, 600, 1), 1, yield, false)};
  SurfaceDescription top = horizontal_square(0, 4000, interface_material()), bottom = horizontal_square(-depth, 4000, interface_material());
  top.inside = m;
  bottom.outside = m;
  c.scene.surfaces = {top, bottom, horizontal_square(-depth * 1.01, 4000, black())};
  c.scene.background.emission = box(350, 400, 1);
  c.options = bins(500, 600, 1);
  c.samples = integrator == IntegratorKind::Mats ? 12000 : 6000;

  const double cosine = std::cos(degrees * kPi / 180);
  const int steps = 2000;
  double length = 0;
  for (int i = 0; i < steps; i++) {
    const double z = (i + 0.5) / steps * depth;
    length += exponential_integral_2((dye_sigma + base_sigma) * z) * std::exp(-base_sigma * z / cosine) / cosine * depth / steps;
  }
  c.measurements = {bins_mean("500-600", c.options, 500, 600, 0.5 * dye_sigma * yield / 100 * band * length)};
  return c;
}

}  // namespace

std::vector<TruthCase> fluorescence_cases() {
  std::vector<TruthCase> cases;
  const IntegratorKind all[] = {IntegratorKind::Mis, IntegratorKind::Mats, IntegratorKind::Nee};
  int index = 0;
  for (const truth::FlatPatch& t : truth::kFlatPatches) cases.push_back(flat_patch(t, index++, IntegratorKind::Mis));
  cases.push_back(flat_patch(truth::kFlatPatches[2], 2, IntegratorKind::Mats));
  cases.push_back(flat_patch(truth::kFlatPatches[2], 2, IntegratorKind::Nee));
  for (const IntegratorKind i : all) cases.push_back(stokes_masked_patch(i));
  for (const IntegratorKind i : all) cases.push_back(measured_patch(i));
  for (const truth::Plates& t : truth::kPlates)
    for (const bool look_at_a : {true, false}) cases.push_back(plates(t, look_at_a, IntegratorKind::Mis));
  for (const IntegratorKind i : all) cases.push_back(cascade(i));
  cases.push_back(dyed_slab(0.8, 0, 0, IntegratorKind::Mis));
  cases.push_back(dyed_slab(0.8, 0, 60, IntegratorKind::Mats));
  cases.push_back(dyed_slab(0.8, 0.5, 45, IntegratorKind::Mis));
  return cases;
}

}  // namespace stokes::tests
