// Media: two of the four coefficients make all, in units of the scene.
#include <algorithm>
#include <cmath>

#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

double metres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Metre: return 1;
    case LengthUnit::Centimetre: return 0.01;
    case LengthUnit::Millimetre: return 0.001;
    case LengthUnit::None: break;
  }
  return 0;
}

// What turns a coefficient in 1/unit into one per scene unit.
double unit_factor(Compilation& c, const MediumDescription& m) {
  if (m.unit == LengthUnit::None) return 1;
  if (c.scene.scene_unit == LengthUnit::None) {
    c.warn(m.pointer + ": the medium has a unit but the scene has none (\"scene unit\"); its coefficients are taken per scene unit");
    return 1;
  }
  return metres(c.scene.scene_unit) / metres(m.unit);
}

// A coefficient as a curve, checked to be finite and not negative.
Curve coefficient(const Compilation& c, const Spectrum& s, const char* name) {
  const Curve curve = c.spectra.curve(s, SpectrumRole::Coefficient);
  for (std::size_t i = 0; i < curve.size(); i++)
    if (!(curve[i] >= 0)) c.fail(s.pointer, std::string(name) + " is negative (" + std::to_string(curve[i]) + ") at " + c.spectra.place(i));
  return curve;
}

struct Coefficients {
  Curve sigma_t, sigma_s;
};

[[noreturn]] void undetermined(const Compilation& c, const MediumDescription& m, std::size_t i, const char* what) {
  c.fail(m.pointer, std::string(what) + " at " + c.spectra.place(i) + " leaves sigma_t undetermined; give sigma_t instead");
}

Coefficients from_sigma_s_and_albedo(const Compilation& c, const MediumDescription& m) {
  Coefficients r{coefficient(c, *m.sigma_s, "sigma_s"), {}};
  r.sigma_s = r.sigma_t;
  const Curve albedo = coefficient(c, *m.albedo, "albedo");
  for (std::size_t i = 0; i < albedo.size(); i++) {
    if (!(albedo[i] > 0)) undetermined(c, m, i, "an albedo of 0 beside sigma_s");
    r.sigma_t[i] /= albedo[i];
  }
  return r;
}

Coefficients from_sigma_a_and_albedo(const Compilation& c, const MediumDescription& m) {
  Coefficients r{coefficient(c, *m.sigma_a, "sigma_a"), {}};
  const Curve albedo = coefficient(c, *m.albedo, "albedo");
  r.sigma_s = r.sigma_t;
  for (std::size_t i = 0; i < albedo.size(); i++) {
    if (albedo[i] > 1) c.fail(m.albedo->pointer, "albedo is " + std::to_string(albedo[i]) + " > 1 at " + c.spectra.place(i));
    if (albedo[i] == 1) undetermined(c, m, i, "an albedo of 1 beside sigma_a");
    r.sigma_t[i] /= 1 - albedo[i];
    r.sigma_s[i] = r.sigma_t[i] * albedo[i];
  }
  return r;
}

Coefficients from_sigma_t(const Compilation& c, const MediumDescription& m) {
  Coefficients r{coefficient(c, *m.sigma_t, "sigma_t"), {}};
  const Curve second = m.sigma_s   ? coefficient(c, *m.sigma_s, "sigma_s")
                       : m.sigma_a ? coefficient(c, *m.sigma_a, "sigma_a")
                                   : coefficient(c, *m.albedo, "albedo");
  r.sigma_s = r.sigma_t;
  for (std::size_t i = 0; i < second.size(); i++)
    r.sigma_s[i] = m.sigma_s ? second[i] : m.sigma_a ? r.sigma_t[i] - second[i] : r.sigma_t[i] * second[i];
  return r;
}

// In 1/unit. Exactly two of the four are given.
Coefficients coefficients(const Compilation& c, const MediumDescription& m) {
  const int given = bool(m.sigma_t) + bool(m.sigma_s) + bool(m.sigma_a) + bool(m.albedo);
  if (given != 2) c.fail(m.pointer, "exactly two of sigma_t, sigma_s, sigma_a and albedo are needed; " + std::to_string(given) + " are given");
  if (m.sigma_t) return from_sigma_t(c, m);
  if (m.albedo) return m.sigma_s ? from_sigma_s_and_albedo(c, m) : from_sigma_a_and_albedo(c, m);
  Coefficients r{coefficient(c, *m.sigma_s, "sigma_s"), coefficient(c, *m.sigma_s, "sigma_s")};
  const Curve sigma_a = coefficient(c, *m.sigma_a, "sigma_a");
  for (std::size_t i = 0; i < sigma_a.size(); i++) r.sigma_t[i] += sigma_a[i];
  return r;
}

// sigma_s must lie in [0, sigma_t]; what rounding leaves outside is put back.
void check_coefficients(const Compilation& c, const MediumDescription& m, Coefficients& k) {
  for (std::size_t i = 0; i < k.sigma_t.size(); i++) {
    if (!std::isfinite(k.sigma_t[i]) || !std::isfinite(k.sigma_s[i])) c.fail(m.pointer, "a coefficient is not finite at " + c.spectra.place(i));
    const double tolerance = 1e-6 * k.sigma_t[i];
    if (k.sigma_s[i] > k.sigma_t[i] + tolerance)
      c.fail(m.pointer, "sigma_s (" + std::to_string(k.sigma_s[i]) + ") is greater than sigma_t (" + std::to_string(k.sigma_t[i]) + ") at " + c.spectra.place(i));
    if (k.sigma_s[i] < -tolerance)
      c.fail(m.pointer, "sigma_a is greater than sigma_t (" + std::to_string(k.sigma_t[i]) + ") at " + c.spectra.place(i));
    k.sigma_s[i] = std::clamp(k.sigma_s[i], 0.0, k.sigma_t[i]);
  }
}

Curve mean_cosine(const Compilation& c, const MediumDescription& m) {
  if (!m.g) return c.spectra.constant(0);
  const Curve g = c.spectra.curve(*m.g, SpectrumRole::Coefficient);
  for (std::size_t i = 0; i < g.size(); i++)
    if (!(g[i] > -1 && g[i] < 1)) c.fail(m.g->pointer, "g must be in (-1, 1); it is " + std::to_string(g[i]) + " at " + c.spectra.place(i));
  return g;
}

// What the medium's dyes absorb joins its extinction.
void add_dyes(Compilation& c, const MediumDescription& m, double factor, Coefficients& k, layout::Medium& out) {
  if (m.dyes.empty()) return;
  if (c.spectra.rgb()) c.fail(m.pointer, "fluorescence needs wavelengths: it cannot be rendered in rgb mode");
  out.first_dye = compile_dyes(c, m.dyes, factor, false);
  out.dye_count = std::uint32_t(m.dyes.size());
  for (std::uint32_t d = 0; d < out.dye_count; d++) {
    const Curve absorption = c.spectra.read(c.out.dyes[out.first_dye + d].absorption);
    for (std::size_t i = 0; i < absorption.size(); i++) k.sigma_t[i] += absorption[i];
  }
  c.out.features.fluorescent_media = true;
}

layout::Medium vacuum(Compilation& c) {
  layout::Medium out{};
  out.sigma_t = out.sigma_s = out.g = c.spectra.add(c.spectra.constant(0));
  out.flags = MEDIUM_ISOTROPIC;
  return out;
}

layout::Medium fill_medium(Compilation& c, const MediumDescription& m) {
  Coefficients k = coefficients(c, m);
  check_coefficients(c, m, k);
  const double factor = unit_factor(c, m);
  for (std::size_t i = 0; i < k.sigma_t.size(); i++) k.sigma_t[i] *= factor, k.sigma_s[i] *= factor;

  layout::Medium out{};
  out.first_dye = 0;
  add_dyes(c, m, factor, k, out);
  const Curve g = mean_cosine(c, m);
  const auto [low_g, high_g] = std::minmax_element(g.begin(), g.end());
  out.sigma_t = c.spectra.add(k.sigma_t);
  out.sigma_s = c.spectra.add(k.sigma_s);
  out.g = c.spectra.add(g);
  if (*low_g == 0 && *high_g == 0) out.flags |= MEDIUM_ISOTROPIC;
  if (!is_flat(k.sigma_t) || !is_flat(g)) {
    out.flags |= MEDIUM_CHROMATIC;
    c.out.features.chromatic_media = true;
  }
  const double densest = *std::max_element(k.sigma_t.begin(), k.sigma_t.end());
  out.mean_free_path = densest > 0 ? float(1 / densest) : 0.0f;
  c.out.features.media = true;
  return out;
}

}  // namespace

std::uint32_t compile_medium(Compilation& c, const MediumDescription* m) {
  if (c.out.media.empty()) c.out.media.push_back(vacuum(c));
  if (!m || m->vacuum) return 0;
  if (const auto known = c.media.find(m); known != c.media.end()) return known->second;
  const layout::Medium out = fill_medium(c, *m);
  c.out.media.push_back(out);
  const auto index = std::uint32_t(c.out.media.size() - 1);
  c.media.emplace(m, index);
  return index;
}

}  // namespace stokes::compiled
