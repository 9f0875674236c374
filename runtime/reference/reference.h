// The CPU reference integrator: double precision, one wavelength per path, written for reading. It renders the same compiled
// scene into the same film as the kernels do, and shares no code with them.
#pragma once
#include <functional>

#include "compiled/compiled_scene.h"
#include "image/film.h"

namespace stokes::reference {

struct Progress {
  std::uint64_t samples_done = 0, samples_total = 0;
  double seconds = 0;
};

/// Adds the samples [begin, end) of every pixel of the film's window to the film, with threads over rows. The result depends on the
/// scene, the seed and the samples alone. `progress` returns false to stop after whole sample passes; returns the end of the samples done.
int render_samples(const CompiledScene& scene, Film& film, std::uint32_t seed, int begin, int end, int threads,
                   const std::function<bool(const Progress&)>& progress);

}  // namespace stokes::reference
