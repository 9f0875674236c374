// Colours and amounts at a point: spectrum references, whether they are tables or textures. Knows nothing of light.
#pragma once
#include "reference/intersect.h"
#include "reference/spectrum.h"

namespace stokes::reference {

/// A spectrum reference's value at a point: a table, or a texture. `wo` matters to `fresnel` alone.
double color_eval(const CompiledScene& scene, std::uint32_t reference, const SurfacePoint& point, Vec3d wo, Wavelength w);

/// A texture's value by its index (no STOKES_TEXTURE_BIT): amounts and masks, and what color_eval goes through.
double texture_eval(const CompiledScene& scene, std::uint32_t texture, const SurfacePoint& point, Vec3d wo, Wavelength w);

/// An image texel (c0, c1, c2, scale) at a wavelength, or (r, g, b, 0) at a channel. Below 380 nm it holds its value at 380 nm.
double texel_eval(const float* texel, Wavelength w);

/// Gradient noise and turbulence as layout.h defines them.
double noise(Vec3d p);
double turbulence(Vec3d p);

}  // namespace stokes::reference
