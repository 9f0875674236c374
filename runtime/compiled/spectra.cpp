// Tabulating, deduplicating and measuring spectra. See spectra.h.
#include "compiled/spectra.h"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace stokes::compiled {

Curve Spectra::curve(const Spectrum& s, SpectrumRole role) const {
  try {
    Curve c;
    if (rgb_) {
      const auto v = rgb_of(s, role);
      c.assign(v.begin(), v.end());
    } else {
      const SpectrumTable t = tabulate(s, role);
      c.assign(t.begin(), t.end());
    }
    for (std::size_t i = 0; i < c.size(); i++)
      if (!std::isfinite(c[i])) throw std::domain_error("the spectrum is not finite at " + place(i));
    return c;
  } catch (const std::domain_error& e) {
    throw SceneError(source_, s.pointer, e.what());
  }
}

std::string Spectra::place(std::size_t i) const {
  static const char* const kChannels[] = {"the red channel", "the green channel", "the blue channel"};
  return rgb_ ? kChannels[i % 3] : std::to_string(int(wavelength(i))) + " nm";
}

double Spectra::integral(const Curve& c) const {
  double sum = 0;
  for (double v : c) sum += v;
  return sum * (kLambdaMax - kLambdaMin) / double(c.size());
}

std::uint32_t Spectra::add(const Curve& c) {
  const std::vector<float> f(c.begin(), c.end());
  const std::size_t key = std::hash<std::string_view>{}({reinterpret_cast<const char*>(f.data()), f.size() * sizeof(float)});
  const auto [first, last] = by_content_.equal_range(key);
  for (auto i = first; i != last; ++i)
    if (std::memcmp(&tables[i->second * size()], f.data(), f.size() * sizeof(float)) == 0) return i->second;
  const auto index = std::uint32_t(tables.size() / size());
  tables.insert(tables.end(), f.begin(), f.end());
  by_content_.emplace(key, index);
  return index;
}

std::uint32_t Spectra::add_interleaved(const Curve& a, const Curve& b) {
  if (rgb_) return 0;
  const auto index = std::uint32_t(tables.size() / size());
  for (std::size_t i = 0; i < size(); i += 2)
    for (const double v : {a[i], a[i + 1], b[i], b[i + 1]}) tables.push_back(float(v));
  return index;
}

Curve Spectra::read(std::uint32_t table) const {
  const auto first = tables.begin() + std::ptrdiff_t(table * size());
  return Curve(first, first + std::ptrdiff_t(size()));
}

bool is_flat(const Curve& c, double tolerance) {
  double low = c[0], high = c[0];
  for (double v : c) low = std::min(low, v), high = std::max(high, v);
  return high - low <= tolerance * std::max(std::abs(low), std::abs(high));
}

}  // namespace stokes::compiled
