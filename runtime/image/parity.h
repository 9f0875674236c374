// Do two renders agree? Tests of pixel blocks and whole-image means against their own variances. Knows films and images, not how
// they were rendered.
#pragma once
#include <string>
#include <vector>

#include "image/film.h"

namespace stokes {

/// Per-pixel means with the variances of these means; R, G, B and, from films, alpha.
struct Estimate {
  int width = 0, height = 0;
  int x = 0, y = 0;  ///< the window's place in the full image, for messages
  struct Channel {
    std::string name;
    std::vector<double> mean, variance;
  };
  std::vector<Channel> channels;
  double samples_per_pixel = 0;  ///< 0: not known
};

/// The means of a film and their variances. Alpha is a coverage of 0 or 1 a sample, so its variance is p (1 - p) / n.
Estimate estimate_of(const Film& film);
/// R, G, B with Variance.R, .G, .B. Throws InputError when a channel is missing.
Estimate estimate_of(const Image& image);

struct ParityOptions {
  double alpha = 0.01;      ///< probability that two renders of the same truth are called different
  int block = 0;            ///< edge of the blocks in pixels; 0: by the samples, so that block means are nearly normal
  double tolerance = 2e-5;  ///< relative rounding error allowed for beside the noise, as a standard deviation
};

/// One test: a block of a channel, or a channel's mean over the image (block width 0).
struct ParityTest {
  std::string channel;
  int x = 0, y = 0, width = 0, height = 0;  ///< in the full image; width 0: the whole image
  double mean_a = 0, mean_b = 0, sigma = 0; ///< sigma: standard deviation of the difference
  double z = 0;
  double p = 1;  ///< two-sided
};

struct ParityResult {
  bool agree = true;
  int block = 0;             ///< edge that was used
  std::size_t tests = 0;
  double threshold = 0;      ///< |z| above which a single test rejects (Sidak-corrected)
  double p = 1;              ///< of the largest |z| among all the tests, Sidak-corrected
  std::vector<ParityTest> means;     ///< one a channel
  std::vector<ParityTest> rejected;  ///< largest |z| first
  ParityTest worst;
};

/// Tests whether `a` and `b` estimate the same image. Where both variances are zero the values must agree within the tolerance.
/// Throws InputError when sizes or channels differ.
ParityResult test_parity(const Estimate& a, const Estimate& b, const ParityOptions& options = {});

/// A few lines for people: the verdict, the means, and where the images part.
std::string describe(const ParityResult& result);

/// Two-sided tail of the standard normal distribution, and its inverse.
double normal_tail(double z);
double normal_quantile(double two_sided_p);

}  // namespace stokes
