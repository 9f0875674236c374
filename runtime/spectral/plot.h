// Pictures of spectra: curves over the wavelength, histograms of samples over them, and the strip of spectral colours.
// Draws tables; reads no scenes and writes no files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "spectral/tabulate.h"

namespace stokes {

struct PlotCurve {
  std::string name;
  SpectrumTable table{};
  std::vector<float> samples;  ///< wavelengths drawn from the curve; where there are some, their histogram is drawn under it
};

struct Plot {
  std::string title;
  std::string y_label;
  std::vector<PlotCurve> curves;
};

/// 8-bit sRGB, row 0 at the top.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The plot as an SVG document (UTF-8); names are escaped.
std::string plot_svg(const Plot& plot, int width = 960, int height = 540);

/// The same plot as pixels.
Pixels plot_pixels(const Plot& plot, int width = 960, int height = 540);

/// 280-780 nm from left to right, each column in its spectral colour, black where the eye sees nothing (outside 380-780 nm).
Pixels wavelength_strip(int width = 1000, int height = 64);

/// The colour, encoded as sRGB in [0, 1], that stands for light of one wavelength on a display: as bright as the display can, cut to
/// its gamut, fading at the ends of the visible range and black outside.
Vec3d display_colour(double lambda);

}  // namespace stokes
