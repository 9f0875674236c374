// What truth cases read off their images.
#pragma once
#include "support/truth_scenes.h"

namespace stokes::tests {

/// A grey pixel: all channels have the same expectation. In RGB mode their mean, in spectral mode the luminance.
inline Measurement grey(ColorMode mode, double expected) {
  if (mode == ColorMode::Rgb) return {"grey", {{"R", 1.0 / 3}, {"G", 1.0 / 3}, {"B", 1.0 / 3}}, expected};
  return {"Y", {{"R", 0.2126390059}, {"G", 0.7151686788}, {"B", 0.0721923154}}, expected};
}

/// The mean over some of the bins of CompileOptions, given by the wavelengths of their first and last edges: radiance per nm.
Measurement bins_mean(const std::string& label, const CompileOptions& options, double begin, double end, double expected);

}  // namespace stokes::tests
