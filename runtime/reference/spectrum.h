// Reading spectrum tables and distributions at one wavelength. A path of the reference carries a single wavelength, or in RGB mode a
// single colour channel, drawn uniformly. Knows nothing of geometry.
#pragma once
#include <cstdint>

#include "compiled/compiled_scene.h"
#include "math/vec.h"

namespace stokes::reference {

/// Where on the spectrum a path is: a wavelength, or a channel of RGB mode.
struct Wavelength {
  double nm = 0;
  int channel = -1;  ///< 0, 1, 2 in RGB mode; else -1
};

/// The wavelength a camera path starts with, and what one unit of its radiance adds to the film.
struct CameraWavelength {
  Wavelength wavelength;
  Vec3d film_weight;       ///< sensor_rgb(lambda) / pdf(lambda)
  double inverse_pdf = 0;  ///< nm
};

/// Draws a camera wavelength from u in [0, 1).
CameraWavelength camera_wavelength(const CompiledScene& scene, double u);

/// The linear sRGB weights of one unit of radiance per nm at `nm`; the constant 1 / int ybar is in them.
Vec3d sensor_rgb(const CompiledScene& scene, double nm);
/// int sensor_rgb dl: the colour of a spectrum that is 1 everywhere.
Vec3d sensor_white(const CompiledScene& scene);

/// A spectrum table's value (not a texture).
double spectrum_eval(const CompiledScene& scene, std::uint32_t table, Wavelength w);

/// Draws a wavelength from a distribution; `pdf` per nm.
double distribution_sample(const CompiledScene& scene, std::uint32_t distribution, double u, double& pdf);
double distribution_pdf(const CompiledScene& scene, std::uint32_t distribution, double nm);

}  // namespace stokes::reference
