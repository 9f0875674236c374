// The spectrum tables of a compiled scene: from descriptions to numbers, and every table stored once. Knows what a table
// means (its role), not who uses it.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/error.h"
#include "spectral/spectrum.h"
#include "spectral/tabulate.h"

namespace stokes::compiled {

/// A spectrum as its table's numbers: 1000 of them (both ends of 500 cells), or three (red, green, blue) in RGB mode.
using Curve = std::vector<double>;

class Spectra {
 public:
  Spectra(bool rgb, const SourceMap& source) : rgb_(rgb), source_(source) {}

  bool rgb() const { return rgb_; }
  std::size_t size() const { return rgb_ ? 3 : 2 * kSpectrumCells; }

  /// The numbers of `s`. Throws SceneError at the spectrum's place where one is not finite.
  Curve curve(const Spectrum& s, SpectrumRole role) const;
  Curve constant(double value) const { return Curve(size(), value); }

  /// Where element `i` of a curve lies: nm, or the channel's number in RGB mode.
  double wavelength(std::size_t i) const { return rgb_ ? double(i) : kLambdaMin + double(i / 2 + i % 2); }
  /// The same in words for messages: "365 nm" or "the green channel".
  std::string place(std::size_t i) const;

  /// int over 280-780 nm; in RGB mode 500 times the channels' mean, so that both are radiance of the same order.
  double integral(const Curve& c) const;

  /// The index of the table with these numbers, a new one if there is none yet.
  std::uint32_t add(const Curve& c);
  std::uint32_t add(const Spectrum& s, SpectrumRole role) { return add(curve(s, role)); }
  /// Two curves as one table of double size, their cells in turn. In RGB mode, whose dyes do not glow, nothing is stored.
  std::uint32_t add_interleaved(const Curve& a, const Curve& b);
  Curve read(std::uint32_t table) const;

  /// All tables in a row, as the layout has them.
  std::vector<float> tables;

 private:
  bool rgb_;
  const SourceMap& source_;
  std::unordered_multimap<std::size_t, std::uint32_t> by_content_;
};

/// True when all values are equal to within `tolerance` relative to the largest.
bool is_flat(const Curve& c, double tolerance = 1e-6);

}  // namespace stokes::compiled
