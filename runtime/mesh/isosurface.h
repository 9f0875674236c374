// From a field on a grid to a closed triangle mesh.
#pragma once
#include "mesh/field.h"
#include "mesh/mesh.h"

namespace stokes {

/// The surface field == level by marching cubes. Ambiguous faces are always cut so that the inside stays apart, which depends on the
/// face's corners alone, so neighbouring cubes agree and the mesh is closed and manifold wherever the surface does not reach the
/// border of the grid. Triangles are counter-clockwise seen from outside. With `refine`, vertices are moved along their grid edges onto
/// the field's level; unless `even` is false they are then spread evenly, as far as no face comes to pass through another, and normals are the field's gradients.
MeshData isosurface(const Grid& grid, double level, const Field* refine = nullptr, bool even = true);

}  // namespace stokes
