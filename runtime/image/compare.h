// How much two images differ: squared errors and a perceptual difference. Knows images only.
#pragma once
#include <vector>

#include "image/film.h"

namespace stokes {

struct ImageDifference {
  double mse = 0;            ///< mean over pixels and R, G, B of (a - b)^2
  double relative_mse = 0;   ///< mean of (a - b)^2 / (b^2 + 0.01); b is the image trusted more
  double flip = 0;           ///< mean FLIP error in [0, 1] of the two as shown on a screen (see flip.h)
  double largest = 0;        ///< largest |a - b|
  int largest_x = 0, largest_y = 0;
  double mean_a[3] = {}, mean_b[3] = {};
  bool identical = true;     ///< every channel that both have is equal in every bit's value, and both have the same channels
  std::uint64_t not_finite = 0;  ///< values of R, G, B in either that are NaN or infinite; left out of the sums
};

/// Compares R, G and B (and for `identical` every channel). Throws InputError when sizes differ or R, G, B are missing.
ImageDifference compare_images(const Image& a, const Image& b);

}  // namespace stokes
