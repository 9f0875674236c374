// The lights: every emissive primitive, the background, the environment; their powers and the table they are chosen by.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiled/alias_table.h"
#include "compiled/bounds.h"
#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

constexpr double kPi = std::numbers::pi;

// The lights while they are collected. Power is over 280-780 nm: light that no eye sees is chosen as often as light that it does.
struct Collection {
  Compilation& c;
  std::vector<double> powers;
  std::map<std::uint32_t, double> integrals;  // by emission reference: int of the mean radiance

  double integral(std::uint32_t emission) {
    const auto [place, fresh] = integrals.try_emplace(emission, 0.0);
    if (fresh) place->second = c.spectra.integral(mean_curve(c, emission));
    return place->second;
  }
};

// Adds a light of `extent` square units (times pi: its share of radiance); its index, or STOKES_NONE when it is dark.
std::uint32_t append_light(Collection& lights, layout::uint type, std::uint32_t primitive, std::uint32_t emission, double area) {
  Compilation& c = lights.c;
  const double power = kPi * area * lights.integral(emission);
  if (!(power > 0)) return STOKES_NONE;
  layout::Light light{};
  light.type = type;
  light.primitive = primitive;
  light.emission = emission;
  light.area = float(area);
  c.out.lights.push_back(light);
  lights.powers.push_back(power);
  return std::uint32_t(c.out.lights.size() - 1);
}

std::uint32_t emission_of(const Compilation& c, std::uint32_t surface) { return c.out.surfaces[surface].emission; }

template <typename Primitive, typename Area>
void append_primitives(Collection& lights, std::vector<Primitive>& primitives, layout::uint type, Area area) {
  for (std::uint32_t i = 0; i < primitives.size(); i++) {
    const std::uint32_t emission = emission_of(lights.c, primitives[i].surface);
    if (emission != STOKES_NONE) primitives[i].light = append_light(lights, type, i, emission, area(primitives[i]));
  }
}

// The light's power over wavelength, for the dyes' excitation.
void add_to_spectrum(Compilation& c, const Curve& radiance, double weight) {
  for (std::size_t i = 0; i < radiance.size(); i++) c.light_spectrum[i] += weight * radiance[i];
}

// An upper bound of what a film value can be when it sees `radiance`: the table's peak, or its colour's largest channel.
void note_peak(Compilation& c, const Curve& radiance) {
  double peak = *std::max_element(radiance.begin(), radiance.end());
  if (!c.spectra.rgb()) {
    SpectrumTable table;
    std::copy(radiance.begin(), radiance.end(), table.begin());
    const Vec3d rgb = xyz_to_rgb(emission_xyz(table));
    peak = std::max({peak, std::abs(rgb.x), std::abs(rgb.y), std::abs(rgb.z)});
  }
  c.peak_radiance = std::max(c.peak_radiance, peak);
}

// What falls on the scene from far away: radiance from all directions on the scene's bounding disc. As an area times pi that is
// 4 pi^2 r^2 = pi * (4 pi r^2).
void append_background(Collection& lights, double radius) {
  Compilation& c = lights.c;
  const BackgroundDescription& background = c.scene.background;
  const double area = 4 * kPi * radius * radius;
  if (background.environment) {
    const Curve mean = compile_environment(c);
    const auto index = std::uint32_t(c.out.lights.size());
    const double power = kPi * area * c.spectra.integral(mean);
    c.out.features.environment = true;
    if (!(power > 0)) return;
    layout::Light light{};
    light.type = layout::LIGHT_ENVIRONMENT;
    light.emission = STOKES_NONE;
    light.area = float(area);
    c.out.lights.push_back(light);
    lights.powers.push_back(power);
    c.out.header.background_light = index;
    add_to_spectrum(c, mean, kPi * area);
  } else if (background.emission) {
    const std::uint32_t emission = compile_color(c, {background.emission, nullptr}, SpectrumRole::Emission, 0);
    if (!(lights.integral(emission) > 0)) return;
    c.out.header.background = emission;
    c.out.header.background_light = append_light(lights, layout::LIGHT_BACKGROUND, 0, emission, area);
    c.out.features.background = true;
  }
}

void fill_alias_table(Collection& lights) {
  if (lights.powers.empty()) return;
  const std::vector<AliasEntry> table = make_alias_table(lights.powers);
  for (std::size_t i = 0; i < table.size(); i++) {
    layout::Light& light = lights.c.out.lights[i];
    light.probability = float(table[i].probability);
    light.alias_threshold = float(table[i].threshold);
    light.alias = table[i].alias;
  }
}

}  // namespace

void compile_lights(Compilation& c) {
  c.light_spectrum = c.spectra.constant(0);
  c.out.header.background = c.out.header.background_light = STOKES_NONE;
  Collection lights{c, {}, {}};

  append_primitives(lights, c.out.quads, layout::LIGHT_QUAD, [](const layout::Quad& q) { return double(q.area); });
  append_primitives(lights, c.out.spheres, layout::LIGHT_SPHERE,
                    [](const layout::Sphere& s) { return 4 * kPi * double(s.radius) * double(s.radius); });
  append_primitives(lights, c.out.ellipsoids, layout::LIGHT_ELLIPSOID, [](const layout::Ellipsoid& e) { return double(e.area); });
  append_primitives(lights, c.out.triangles, layout::LIGHT_TRIANGLE, [](const layout::Triangle& t) { return double(t.area); });
  append_background(lights, scene_bounds(c.out).radius());

  // Per emission: its power over wavelength and how bright it can be.
  std::map<std::uint32_t, double> area_by_emission;
  for (const layout::Light& light : c.out.lights)
    if (light.emission != STOKES_NONE) area_by_emission[light.emission] += kPi * double(light.area);
  for (const auto& [emission, area] : area_by_emission) {
    add_to_spectrum(c, mean_curve(c, emission), area);
    note_peak(c, peak_curve(c, emission));
  }

  fill_alias_table(lights);
  if (c.out.lights.empty()) c.warn("the scene has no light at all: the image will be black");
}

}  // namespace stokes::compiled
