// The film's side of the spectrum: colour matching functions and D65 on the very cells that tables have, and integrals over them.
// Internal to runtime/spectral.
#pragma once
#include <array>

#include "spectral/tabulate.h"

namespace stokes {

/// Values at both ends of the 500 cells, in double precision: what a SpectrumTable is rounded from.
using CellEnds = std::array<double, 2 * kSpectrumCells>;

/// The colour matching functions (divided by int ybar) at the cells' ends. The cell below 360 nm ends in 0, the cell above starts with
/// the table's first value.
struct CieCells {
  std::array<Vec3d, 2 * kSpectrumCells> xyz;
};
const CieCells& cie_cells();
/// d65() at the cells' ends.
const CellEnds& d65_cells();

/// int L xbar / int ybar (and y, z), exact for curves that are linear in each cell.
Vec3d integrate_xyz(const CellEnds& radiance);
/// Likewise for the product of two curves that are linear in each cell.
Vec3d integrate_xyz(const CellEnds& reflectance, const CellEnds& light);

/// Relative power of an illuminant ("D65", "A", "E", "F11") before normalisation; `from_left` asks for the limit from below.
/// Throws std::domain_error for any other name.
double illuminant_power(const std::string& name, double lambda, bool from_left);

}  // namespace stokes
