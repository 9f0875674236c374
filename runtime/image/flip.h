// FLIP: the difference that a viewer sees when flipping between two images (Andersson et al. 2020). Knows images only.
#pragma once
#include "image/film.h"

namespace stokes {

/// Mean FLIP error in [0, 1] of the R, G, B of two images of one size, clipped to [0, 1] as a screen would show them; values that
/// are not finite count as 0. 67 pixels per degree is the paper's default: a 4K screen of 0.7 m width seen from 0.7 m.
double flip_difference(const Image& reference, const Image& test, double pixels_per_degree = 67.0);

}  // namespace stokes
