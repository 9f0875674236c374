// Cumulative tables as the kernels read them: cells, and guides that say where to look. Knows the layout, not what is summed up.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "layout.h"

namespace stokes {

/// Appends the table of a density to `out`: STOKES_CDF_STRIDE floats. `density` has both ends of each cell and that integral, `cdf` the sums 0 ... 1.
inline void append_cumulative_table(std::vector<float>& out, std::span<const float> density, double integral,
                                    const std::array<float, STOKES_SPECTRUM_CELLS + 1>& cdf) {
  for (std::size_t c = 0; c < STOKES_SPECTRUM_CELLS; c++) {
    const float cell[] = {cdf[c], cdf[c + 1], float(density[2 * c] / integral), float(density[2 * c + 1] / integral)};
    out.insert(out.end(), std::begin(cell), std::end(cell));
  }
  std::size_t cell = 0;
  for (int i = 0; i < STOKES_CDF_GUIDES; i++) {
    while (cell + 1 < STOKES_SPECTRUM_CELLS && cdf[cell + 1] <= float(i) / STOKES_CDF_GUIDES) cell++;
    out.push_back(float(cell));
  }
}

}  // namespace stokes
