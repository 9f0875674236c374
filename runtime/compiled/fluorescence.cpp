// Dyes: normalised emissions, absorptions with their concentrations, the energy they may give off, and the tables that
// excitation wavelengths are drawn from.
#include <algorithm>
#include <cmath>

#include "compiled/compilation.h"
#include "compiled/cumulative_table.h"

namespace stokes::compiled {
namespace {

// Measured curves may dip below zero by noise.
Curve dye_curve(const Compilation& c, const DyeDescription& dye, const SpectrumPtr& s, const char* name) {
  if (!s) c.fail(dye.pointer, std::string("a dye needs its ") + name + " curve");
  Curve curve = c.spectra.curve(*s, SpectrumRole::Dye);
  const double peak = *std::max_element(curve.begin(), curve.end());
  for (std::size_t i = 0; i < curve.size(); i++) {
    if (curve[i] < -0.01 * std::max(peak, 0.0)) c.fail(s->pointer, std::string(name) + " is negative (" + std::to_string(curve[i]) + ") at " + c.spectra.place(i));
    curve[i] = std::max(curve[i], 0.0);
  }
  return curve;
}

void check_yield(const Compilation& c, const DyeDescription& dye, bool surface) {
  if (!(dye.yield >= 0) || !std::isfinite(dye.yield)) c.fail(dye.pointer, "a dye's yield must not be negative");
  if (!(dye.concentration >= 0) || !std::isfinite(dye.concentration)) c.fail(dye.pointer, "a dye's concentration must not be negative");
  if (surface && dye.concentration > 1) c.fail(dye.pointer, "a surface dye's concentration must be in [0, 1]");
  if (!surface && dye.yield > 1) c.fail(dye.pointer, "a dye's yield in a medium must be in [0, 1]");
}

// int of a product with wavelength: tables of energy times l for photon yields.
Curve times_wavelength(const Spectra& s, Curve c) {
  for (std::size_t i = 0; i < c.size(); i++) c[i] *= s.wavelength(i);
  return c;
}

layout::Dye fill_dye(Compilation& c, const DyeDescription& dye, double factor, bool surface) {
  check_yield(c, dye, surface);
  Curve absorption = dye_curve(c, dye, dye.absorption, "absorption"), emission = dye_curve(c, dye, dye.emission, "emission");
  for (double& v : absorption) v *= dye.concentration * factor;
  const double integral = c.spectra.integral(emission);
  if (!(integral > 0)) c.fail(dye.emission->pointer, "the emission curve is zero from 280 to 780 nm");
  for (double& v : emission) v /= integral;

  layout::Dye out{};
  const Curve drawn = dye.photon_yield ? times_wavelength(c.spectra, absorption) : absorption;
  out.absorption = c.spectra.add(absorption);
  out.emission = c.spectra.add(emission);
  out.curves = c.spectra.add_interleaved(absorption, emission);
  out.yield = float(dye.yield);
  out.strength = float(c.spectra.integral(drawn) * dye.yield);
  out.flags = (dye.photon_yield ? DYE_PHOTON_YIELD : 0u) | (dye.stokes ? DYE_STOKES : 0u);
  out.excitation = reserve_excitation(c, drawn);
  return out;
}

// int K(li, lo) dlo over a(li): the energy that a dye gives off per energy absorbed at li.
double emitted_fraction(const Spectra& s, const layout::Dye& dye, const Curve& emission, double li) {
  double sum = 0;
  for (std::size_t i = 0; i < emission.size(); i++) {
    const double lo = s.wavelength(i);
    if ((dye.flags & DYE_STOKES) && lo < li) continue;
    sum += emission[i] * (dye.flags & DYE_PHOTON_YIELD ? li / lo : 1.0);
  }
  return dye.yield * sum * (kLambdaMax - kLambdaMin) / double(emission.size());
}

// Scaled to integrate to 1, or empty when there is nothing.
Curve normalised(const Spectra& s, Curve c) {
  const double integral = s.integral(c);
  if (!(integral > 0)) return {};
  for (double& v : c) v /= integral;
  return c;
}

}  // namespace

std::uint32_t compile_dyes(Compilation& c, const std::vector<DyeDescription>& dyes, double factor, bool surface) {
  const auto first = std::uint32_t(c.out.dyes.size());
  for (const DyeDescription& dye : dyes) c.out.dyes.push_back(fill_dye(c, dye, factor, surface));
  return first;
}

void check_energy(const Compilation& c, std::uint32_t first_dye, std::uint32_t count, const Curve& base, const std::string& pointer) {
  std::vector<Curve> absorption, emission;
  for (std::uint32_t d = 0; d < count; d++) {
    absorption.push_back(c.spectra.read(c.out.dyes[first_dye + d].absorption));
    emission.push_back(c.spectra.read(c.out.dyes[first_dye + d].emission));
  }
  double worst_absorbed = 0, worst_given = 0;
  std::size_t absorbed_at = 0, given_at = 0;
  for (std::size_t i = 0; i < base.size(); i++) {
    double absorbed = 0, emitted = 0;
    for (std::uint32_t d = 0; d < count; d++) {
      const double a = absorption[d][i];
      absorbed += a;
      if (a > 0) emitted += a * emitted_fraction(c.spectra, c.out.dyes[first_dye + d], emission[d], c.spectra.wavelength(i));
    }
    const double given = (1 - absorbed) * base[i] + emitted;
    if (absorbed > worst_absorbed) worst_absorbed = absorbed, absorbed_at = i;
    if (given > worst_given) worst_given = given, given_at = i;
  }
  const double limit = 1 + 1e-5;
  if (worst_absorbed > limit)
    c.fail(pointer, "the dyes absorb " + std::to_string(worst_absorbed) + " > 1 of the light at " + c.spectra.place(absorbed_at));
  if (worst_given > limit)
    c.fail(pointer, "the material gives off " + std::to_string(worst_given) + " > 1 times the energy it receives at " + c.spectra.place(given_at));
}

std::uint32_t reserve_excitation(Compilation& c, Curve absorption) {
  const auto index = std::uint32_t(c.out.distributions.size());
  c.out.distributions.push_back({});
  c.excitations.push_back({index, std::move(absorption)});
  return index;
}

// Half of the density follows the absorption, half its product with the light: where a lamp has lines the second wins, where it
// does not shine the first still covers what indirect light may bring.
void complete_excitations(Compilation& c) {
  for (const PendingExcitation& pending : c.excitations) {
    const Curve absorption = normalised(c.spectra, pending.absorption);
    Curve product = pending.absorption;
    for (std::size_t i = 0; i < product.size(); i++) product[i] *= c.light_spectrum[i];
    product = normalised(c.spectra, std::move(product));

    Curve density = absorption.empty() ? c.spectra.constant(1 / (kLambdaMax - kLambdaMin)) : absorption;
    if (!product.empty())
      for (std::size_t i = 0; i < density.size(); i++) density[i] = (density[i] + product[i]) / 2;

    SpectrumTable table;
    std::copy(density.begin(), density.end(), table.begin());
    const TableDistribution d = make_distribution(table);
    layout::Distribution& out = c.out.distributions[pending.distribution];
    out.spectrum = c.spectra.add(density);
    out.cdf = std::uint32_t(c.out.cdfs.size() / STOKES_CDF_STRIDE);
    out.integral = float(d.integral);
    out.strength = float(c.spectra.integral(pending.absorption));
    append_cumulative_table(c.out.cdfs, table, d.integral, d.cdf);
  }
  c.excitations.clear();
}

}  // namespace stokes::compiled
