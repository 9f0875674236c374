// Bispectral images in the EXR layout of Fichet, Pacanowski and Wilkie, "An OpenEXR Layout for Spectral Images" (JCGT 10(3), 2021).
// Knows image files, not scenes.
#pragma once
#include <string>

#include "scene/description.h"

namespace stokes {

/// The matrix of a bispectral image: channel `T.<in>nm` is the diagonal, `T.<in>nm.<out>nm` what goes from one band to another (energy out
/// in the band per energy in), with decimal commas. Channels that are missing are 0; those of other names are left alone. A matrix of
/// more than one pixel is the mean over all of them. Throws std::runtime_error with the reason.
ReradiationMatrix read_bispectral_exr(const std::string& path);

}  // namespace stokes
