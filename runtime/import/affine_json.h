// Affine maps of the importers and how they are written as a transform of ours.
#pragma once
#include "import/imported_scene.h"
#include "math/vec.h"

namespace stokes {

Affine translation_of(Vec3d t);
Affine scaling_of(Vec3d s);
/// By degrees about an axis of length 1. (With another length it is no rotation, but what Mitsuba 3 makes of such an axis.)
Affine rotation_of(double degrees, Vec3d axis);
/// From a camera's or object's frame to the world: +z towards `target`, +y up, +x = up x z (as both Mitsuba and pbrt have it).
Affine look_at_of(Vec3d origin, Vec3d target, Vec3d up);
/// Row by row; the last row must be 0 0 0 1 (false otherwise).
bool matrix_of(const std::vector<double>& m, Affine& out);

/// Normals at the corners of a mesh that has none, as Mitsuba makes them: sums of the adjacent faces', weighted by their angles in the world.
void give_smooth_normals(ImportedMesh& mesh, const Affine& to_world);

/// {"matrix": ...}, or null for the identity.
ImportJson transform_json(const Affine& a);

}  // namespace stokes
