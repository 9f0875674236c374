// Which media are so thin that the light of lamps in them is sought along every flight: see kernels/airlight.cl and the reference's.
#include <algorithm>
#include <cmath>
#include <map>

#include "compiled/bounds.h"
#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

// In optical thicknesses. In a medium that is dense against the scene most flights scatter anyhow; near a lamp that is large against the
// mean free path enough of them do. Then what is sought along the flights would not repay its time (measured).
constexpr double kThinScene = 5, kThinLamp = 0.1;

std::uint32_t surface_of(const Compilation& c, const layout::Light& l) {
  switch (l.type) {
    case layout::LIGHT_QUAD: return c.out.quads[l.primitive].surface;
    case layout::LIGHT_SPHERE: return c.out.spheres[l.primitive].surface;
    case layout::LIGHT_ELLIPSOID: return c.out.ellipsoids[l.primitive].surface;
    case layout::LIGHT_TRIANGLE: return c.out.triangles[l.primitive].surface;
  }
  return STOKES_NONE;  // the surroundings
}

/// The size of the lamps, weighted by their powers; 0 without any. A mesh is one lamp.
double lamp_size(const Compilation& c) {
  struct Lamp {
    double area = 0, power = 0;
  };
  std::map<std::uint32_t, Lamp> lamps;
  for (const layout::Light& l : c.out.lights)
    if (const std::uint32_t surface = surface_of(c, l); surface != STOKES_NONE) {
      lamps[surface].area += double(l.area);
      lamps[surface].power += double(l.probability);
    }
  double size = 0, power = 0;
  for (const auto& [surface, lamp] : lamps) {
    size += lamp.power * std::sqrt(lamp.area);
    power += lamp.power;
  }
  return power > 0 ? size / power : 0;
}

bool scatters(const Compilation& c, const layout::Medium& m) {
  const Curve sigma_s = c.spectra.read(m.sigma_s);
  return std::any_of(sigma_s.begin(), sigma_s.end(), [](double s) { return s > 0; });
}

}  // namespace

void mark_thin_media(Compilation& c) {
  const IntegratorKind kind = c.scene.integrator.kind;
  const bool seeks_light = kind == IntegratorKind::Nee || kind == IntegratorKind::Mis;
  const double lamps = lamp_size(c), radius = scene_bounds(c.out).radius();
  if (!c.scene.integrator.equiangular || !seeks_light || !(lamps > 0)) return;
  for (std::size_t i = 1; i < c.out.media.size(); i++) {
    layout::Medium& m = c.out.media[i];
    // From a sealed medium no light is sought; dyes have a branch of their own.
    const double free_path = double(m.mean_free_path);
    const bool thin = radius <= kThinScene * free_path && lamps <= kThinLamp * free_path;
    if (!thin || m.dye_count > 0 || (m.flags & MEDIUM_SEALED) || !scatters(c, m)) continue;
    m.flags |= MEDIUM_THIN;
    c.out.features.thin_media = true;
  }
}

}  // namespace stokes::compiled
