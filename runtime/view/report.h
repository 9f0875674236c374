// Two renders of one scene side by side as one HTML file that needs nothing else. Knows images and statistics, not who made them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "image/compare.h"
#include "image/parity.h"

namespace stokes {

/// The error of a growing render: root of the mean squared difference from the truth, without the truth's own noise.
struct ConvergencePoint {
  int samples = 0;
  double error = 0;
};

/// One comparison. Both images have R, G, B and one size; Variance and spectral channels ("S0...nm") are shown where both have them.
struct ReportCase {
  std::string name, name_a, name_b;
  Image a, b;
  ImageDifference difference;
  std::optional<ParityResult> parity;
  bool different = false;
  std::vector<ConvergencePoint> convergence;  ///< may be empty
};

/// The page. Spectra are kept in at most 64 x 64 cells, each the mean of its pixels.
std::string comparison_report(const std::string& title, const std::vector<ReportCase>& cases);

/// The error of `film` against `truth`, over all pixels and R, G, B: the mean squared difference less the variance of the truth's
/// own means; its root. 0 where that is less than five of its own standard errors, so that the truth's noise hides it.
double convergence_error(const Film& film, const Film& truth);

}  // namespace stokes
