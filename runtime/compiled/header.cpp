// The numbers about the whole scene: counts, bounds, the film's units, the camera's wavelengths.
#include <algorithm>
#include <cmath>

#include "compiled/bounds.h"
#include "compiled/compilation.h"
#include "compiled/rooms.h"
#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

layout::uint integrator_type(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::Mats: return layout::INTEGRATOR_MATS;
    case IntegratorKind::Nee: return layout::INTEGRATOR_NEE;
    case IntegratorKind::Mis: return layout::INTEGRATOR_MIS;
    case IntegratorKind::Normals: return layout::INTEGRATOR_NORMALS;
    case IntegratorKind::Ao: return layout::INTEGRATOR_AO;
  }
  return layout::INTEGRATOR_MIS;
}

// A power of two `bits` below the smallest one that is at least `value`.
float quantum(double value, int bits) { return float(std::ldexp(1.0, int(std::clamp(std::ceil(std::log2(value)), -80.0, 100.0)) - bits)); }

layout::uint film_stride(const CompileOptions& o) {
  const unsigned channels = o.film_channels;
  return FILM_BASE_WORDS + (channels & FILM_ALBEDO ? 3 : 0) + (channels & FILM_NORMAL ? 3 : 0) + (channels & FILM_DEPTH ? 1 : 0) +
         (channels & FILM_FLUORESCENCE ? 4 : 0) + layout::uint(o.spectral_bins) * (channels & FILM_FLUORESCENT_BINS ? 2 : 1);
}

void fill_film(Compilation& c, layout::Scene& h) {
  const CompileOptions& o = c.options;
  if (o.spectral_bins > 0 && c.spectra.rgb()) throw SceneError("error: spectral bins need wavelengths: they cannot be rendered in rgb mode");
  if ((o.film_channels & FILM_FLUORESCENT_BINS) && (o.spectral_bins == 0 || !(o.film_channels & FILM_FLUORESCENCE)))
    throw SceneError("error: the spectrum of fluorescent light needs spectral bins and the fluorescence channel");
  // 40 bits below the brightest emission; sums of radiance over wavelength need up to 500 times the room.
  const bool energies = (o.film_channels & FILM_FLUORESCENCE) || o.spectral_bins > 0;
  h.film_quantum = quantum(c.peak_radiance > 0 ? c.peak_radiance : 1, energies ? 34 : 40);
  h.film_channels = o.film_channels;
  h.film_stride = film_stride(o);
  h.spectral_bins = layout::uint(o.spectral_bins);
  h.spectral_begin = float(o.spectral_begin);
  h.spectral_end = float(o.spectral_end);
}

void fill_box(Compilation& c, layout::Scene& h, const Bounds& box) {
  if (!box.empty()) {
    h.box_low = to_float(box.low);
    h.box_high = to_float(box.high);
  }
  const std::vector<layout::Room> rooms = find_rooms(c.out.quads);
  h.room_count = layout::uint(rooms.size());
  h.room_quads[0] = h.room_quads[1] = 0;
  for (std::size_t i = 0; i < rooms.size(); i++) {
    h.rooms[i] = rooms[i];
    for (const int quad : rooms[i].faces)
      if (quad >= 0) h.room_quads[quad / 32] |= 1u << (quad % 32);
  }
}

}  // namespace

// Depths are measured from the camera, which may stand far outside.
float depth_quantum(const layout::Scene& h) {
  return quantum(double(h.scene_radius) + length(to_double(h.camera.position) - to_double(h.scene_center)), 40);
}

void compile_header(Compilation& c) {
  layout::Scene& h = c.out.header;
  const IntegratorDescription& integrator = c.scene.integrator;
  h.integrator = integrator_type(integrator.kind);
  if (integrator.max_bounces < 0) c.fail("/integrator", "max bounces must not be negative");
  h.max_bounces = layout::uint(integrator.max_bounces);
  h.russian_roulette = integrator.russian_roulette ? layout::uint(std::max(*integrator.russian_roulette, 0)) : STOKES_NONE;
  h.quad_count = layout::uint(c.out.quads.size());
  h.sphere_count = layout::uint(c.out.spheres.size());
  h.ellipsoid_count = layout::uint(c.out.ellipsoids.size());
  h.triangle_count = layout::uint(c.out.triangles.size());
  h.light_count = layout::uint(c.out.lights.size());
  h.has_environment = c.out.features.environment;

  const Bounds box = scene_bounds(c.out);
  h.scene_center = to_float(box.center());
  h.scene_radius = float(box.radius());
  h.depth_quantum = depth_quantum(h);
  fill_film(c, h);
  fill_box(c, h, box);

  const int wavelengths = integrator.wavelengths_per_path;
  if (wavelengths != 1 && wavelengths != 4 && wavelengths != 8) c.fail("/integrator", "wavelengths per path must be 1, 4 or 8");
  c.out.wavelengths_per_path = c.spectra.rgb() ? 3 : wavelengths;
  c.out.samples = c.scene.samples;
  c.out.seed = c.scene.seed;
  c.out.bvh_width = c.options.bvh_width;
  c.out.camera_knots = camera_knots(STOKES_CAMERA_KNOTS, c.options.spectral_bins, c.options.spectral_begin, c.options.spectral_end);
  c.out.sensor = sensor_table();
}

}  // namespace stokes::compiled
