// Which media are so thin that the light of lamps in them is sought along every flight: see kernels/airlight.cl and the reference's.
#include <algorithm>

#include "compiled/bounds.h"
#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

// In optical thicknesses of the scene's radius. Denser media scatter most flights anyhow.
constexpr double kThin = 5;

bool has_lamps(const Compilation& c) {
  return std::any_of(c.out.lights.begin(), c.out.lights.end(),
                     [](const layout::Light& l) { return l.type != layout::LIGHT_BACKGROUND && l.type != layout::LIGHT_ENVIRONMENT; });
}

bool scatters(const Compilation& c, const layout::Medium& m) {
  const Curve sigma_s = c.spectra.read(m.sigma_s);
  return std::any_of(sigma_s.begin(), sigma_s.end(), [](double s) { return s > 0; });
}

}  // namespace

void mark_thin_media(Compilation& c) {
  const IntegratorKind kind = c.scene.integrator.kind;
  const bool seeks_light = kind == IntegratorKind::Nee || kind == IntegratorKind::Mis;
  if (!c.scene.integrator.equiangular || !seeks_light || !has_lamps(c)) return;
  const double radius = scene_bounds(c.out).radius();
  for (std::size_t i = 1; i < c.out.media.size(); i++) {
    layout::Medium& m = c.out.media[i];
    // From a sealed medium no light is sought; dyes have a branch of their own.
    const bool thin = radius <= kThin * double(m.mean_free_path);
    if (!thin || m.dye_count > 0 || (m.flags & MEDIUM_SEALED) || !scatters(c, m)) continue;
    m.flags |= MEDIUM_THIN;
    c.out.features.thin_media = true;
  }
}

}  // namespace stokes::compiled
