// Short ways to write SceneDescriptions in C++ for tests.
#pragma once
#include <memory>

#include "scene/description.h"

namespace stokes::tests {

/// The same value at every wavelength; as an emission D65-shaped, so that the pixel is that grey.
SpectrumPtr number(double value);
/// Truly constant in wavelength, also as an emission.
SpectrumPtr constant(double value);
/// `value` from `begin` to `end` nm, 0 elsewhere.
SpectrumPtr box(double begin, double end, double value);
SpectrumPtr sum(std::vector<SpectrumPtr> of);

MaterialPtr lambertian(double albedo);
MaterialPtr dielectric(double ior);
MaterialPtr interface_material();
/// Absorbs everything.
MaterialPtr black();

/// Coefficients per scene unit, the same at every wavelength.
MediumPtr medium(double sigma_t, double albedo, double g);

/// A square of the given side, centred at (0, 0, z) with its normal up (+z).
SurfaceDescription horizontal_square(double z, double side, MaterialPtr material);
SurfaceDescription rectangle(const Affine& transform, double width, double height, MaterialPtr material);
SurfaceDescription sphere(Vec3d center, double radius, MaterialPtr material);

Affine translation(Vec3d t);
Affine scaling(Vec3d s);
/// Columns x, y, z and an origin.
Affine frame(Vec3d x, Vec3d y, Vec3d z, Vec3d origin);

/// A camera without perspective that looks at `at` from the direction at `degrees` to +z (in the xz-plane), from `distance` away; its
/// film covers `height` units.
CameraDescription parallel_camera(double degrees, double distance, double height, int pixels, Vec3d at = {});

/// A scene with that camera, no background, no roulette before `roulette` bounces.
SceneDescription empty_scene(const CameraDescription& camera, IntegratorKind integrator, ColorMode mode);

/// Triangles of a cube of the given half side.
std::shared_ptr<const MeshData> cube_mesh(double half);

}  // namespace stokes::tests
