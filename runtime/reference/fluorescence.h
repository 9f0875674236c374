// Wavelength shifts of dyes and measured matrices, seen from the camera's side: light that leaves at `lo` came in at `li`.
// Knows nothing of paths or directions: all re-emission is diffuse (surfaces) or isotropic (media).
#pragma once
#include "reference/random.h"
#include "reference/texture.h"

namespace stokes::reference {

/// K(li, lo) of one dye in 1/nm (surfaces), or 1/(nm * scene unit) (media). 0 where a Stokes mask forbids it.
double dye_kernel(const CompiledScene& scene, const layout::Dye& dye, double li, double lo);
/// int K(li, lo) dli of one dye; an upper bound where it is Stokes-masked. Dimensionless, or per scene unit.
double dye_gain(const CompiledScene& scene, const layout::Dye& dye, double lo);

/// A wavelength that is excited, and K over its density and over the probability of the chosen dye.
struct Excitation {
  double li = 0;
  double weight = 0;  ///< 0: nothing comes of it
};
/// Chooses a dye by its gain, then an excitation wavelength. The gains must not all be zero.
Excitation dyes_sample(const CompiledScene& scene, std::uint32_t first_dye, std::uint32_t count, double lo, Random& random);
/// The sum of the dyes' gains.
double dyes_gain(const CompiledScene& scene, std::uint32_t first_dye, std::uint32_t count, double lo);

/// K(li, lo) of a measured matrix in 1/nm, bilinear between its points and 0 outside.
double reradiation_kernel(const CompiledScene& scene, const layout::Reradiation& matrix, double li, double lo);
/// int K(li, lo) dli, exactly.
double reradiation_gain(const CompiledScene& scene, const layout::Reradiation& matrix, double lo);
/// An excitation wavelength with the density K(li, lo) / gain, exactly; the weight is the gain.
Excitation reradiation_sample(const CompiledScene& scene, const layout::Reradiation& matrix, double lo, double u);

/// What a diffuse surface with wavelength shifts does to one path: it reflects at the same wavelength or takes another one.
struct DiffuseBranch {
  bool fluoresced = false;
  Wavelength wavelength;  ///< on the light's side
  double weight = 0;      ///< albedo or K / density, over the branch's probability; the BSDF is weight / pi
};
/// One branch, by the share of each. `material` is FLUORESCENT or RERADIATION. In RGB mode there are no shifts.
DiffuseBranch diffuse_branch_sample(const CompiledScene& scene, const layout::Material& material, const SurfacePoint& point, Vec3d wo,
                                    Wavelength lo, Random& random);

}  // namespace stokes::reference
