// Values of options from their text. Everything here throws UsageError naming the option.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/description.h"

namespace stokes {

/// A rectangle of pixels [x0, x1) x [y0, y1).
struct PixelWindow {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// "60", "60s", "500ms", "2m", "1.5h" in seconds; positive.
double parse_duration(const std::string& option, const std::string& text);
/// "640x480".
std::pair<int, int> parse_size(const std::string& text);
/// "x0,x1,y0,y1" of a width x height image: fractions where all are at most 1, else pixels; not empty.
PixelWindow parse_crop(const std::string& text, int width, int height);
/// "a:b" with 0 <= a < b.
std::pair<int, int> parse_samples(const std::string& text);

struct SpectralBins {
  int count = 0;
  double begin = 0, end = 0;
};
/// "a:b:n": n bins within 280-780 nm.
SpectralBins parse_spectral(const std::string& text);

struct AovChoice {
  unsigned channels = 0;  ///< FILM_*
  bool variance = false;
};
/// A comma-separated list of albedo, normal, depth, variance, fluorescence, or all.
AovChoice parse_aovs(const std::string& text);

/// "/json/pointer=VALUE".
std::pair<std::string, std::string> parse_setting(const std::string& text);

/// The integrator that a name of the scene format, or its short form (mats, nee, mis, normals, ao), stands for.
IntegratorKind parse_integrator(const std::string& name);

/// The parts between separators; empty parts are kept.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace stokes
