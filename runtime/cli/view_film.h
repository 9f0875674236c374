// What the film of a view holds: as much as a page can show and memory allows. Knows scenes and sizes.
#pragma once
#include "cli/scene_options.h"

namespace stokes {

/// Albedo, normal and depth; the spectrum from 280 to 780 nm in as many bins as fit, unless `bins` asks for others or the scene is RGB;
/// where the scene fluoresces, what was excited apart, as colours and as spectrum.
FilmChoice view_film(const SceneDescription& scene, const SpectralBins& bins);

/// Whether any surface or medium in use has dyes or a reradiation matrix.
bool fluoresces(const SceneDescription& scene);

}  // namespace stokes
