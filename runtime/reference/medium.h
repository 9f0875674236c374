// Flights through homogeneous media at one wavelength. Knows nothing of surfaces beyond their distance.
#pragma once
#include "reference/random.h"
#include "reference/spectrum.h"

namespace stokes::reference {

/// A medium's coefficients at one wavelength, per scene unit.
struct MediumAt {
  double sigma_t = 0, sigma_s = 0, g = 0;
  std::uint32_t first_dye = 0, dye_count = 0;
};
MediumAt medium_at(const CompiledScene& scene, std::uint32_t medium, Wavelength w);

/// exp(-sigma_t distance); 1 in vacuum, also at infinity.
double transmittance(const CompiledScene& scene, std::uint32_t medium, double distance, Wavelength w);

/// How a flight ends.
struct Flight {
  enum class End { Surface, Scattering, Fluorescence } end = End::Surface;
  double t = 0;           ///< distance to the scattering or the fluorescence
  double weight = 1;      ///< on the path's throughput; 0: absorbed for good
  Wavelength wavelength;  ///< after the event: that of the excitation at a fluorescence
};

/// Flies towards a surface at the distance t_max (infinite: none). Scattering is analog: a collision happens with density
/// sigma_t exp(-sigma_t t) and weighs by the albedo. In a medium with dyes a fluorescent source on the way is one branch, the
/// ordinary flight the other.
Flight medium_flight(const CompiledScene& scene, std::uint32_t medium, double t_max, Wavelength w, Random& random);

}  // namespace stokes::reference
