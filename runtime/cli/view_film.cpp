// What the film of a view holds. See view_film.h.
#include "cli/view_film.h"

#include "layout.h"

namespace stokes {
namespace {

// A film is held four times over while it is rendered and looked at.
constexpr double kFilmBytes = 512.0 * 1024 * 1024;

bool fluoresces(const MaterialPtr& m) { return m && (!m->dyes.empty() || m->matrix || fluoresces(m->a) || fluoresces(m->b)); }
bool fluoresces(const MediumPtr& m) { return m && !m->dyes.empty(); }

}  // namespace

bool fluoresces(const SceneDescription& scene) {
  for (const SurfaceDescription& s : scene.surfaces)
    if (fluoresces(s.material) || fluoresces(s.outside) || fluoresces(s.inside)) return true;
  return scene.camera.medium && fluoresces(*scene.camera.medium);
}

FilmChoice view_film(const SceneDescription& scene, const SpectralBins& bins) {
  FilmChoice choice;
  choice.bins = bins;
  choice.aovs.channels = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH;
  choice.aovs.variance = true;
  const bool apart = fluoresces(scene);
  if (apart) choice.aovs.channels |= FILM_FLUORESCENCE;
  const bool rgb = scene.integrator.mode == ColorMode::Rgb || scene.integrator.kind == IntegratorKind::Normals || scene.integrator.kind == IntegratorKind::Ao;
  if (bins.count == 0 && !rgb) {
    const double words = kFilmBytes / 8 / (static_cast<double>(scene.camera.width) * scene.camera.height_pixels) - FILM_BASE_WORDS - 11;
    for (const int count : {10, 20, 25, 50})
      if (count * (apart ? 2 : 1) <= words) choice.bins = {count, 280, 780};
  }
  if (apart && choice.bins.count > 0) choice.aovs.channels |= FILM_FLUORESCENT_BINS;
  return choice;
}

}  // namespace stokes
