// Dyes and the branch at a fluorescent surface. See fluorescence.h.
#include "reference/fluorescence.h"

#include <algorithm>

namespace stokes::reference {

double dye_kernel(const CompiledScene& scene, const layout::Dye& dye, double li, double lo) {
  if ((dye.flags & DYE_STOKES) && lo < li) return 0;
  const double energy = spectrum_eval(scene, dye.absorption, {li, -1}) * dye.yield * spectrum_eval(scene, dye.emission, {lo, -1});
  return dye.flags & DYE_PHOTON_YIELD ? energy * li / lo : energy;
}

double dye_gain(const CompiledScene& scene, const layout::Dye& dye, double lo) {
  const double emission = spectrum_eval(scene, dye.emission, {lo, -1});
  return dye.strength * (dye.flags & DYE_PHOTON_YIELD ? emission / lo : emission);
}

double dyes_gain(const CompiledScene& scene, std::uint32_t first_dye, std::uint32_t count, double lo) {
  double sum = 0;
  for (std::uint32_t d = first_dye; d < first_dye + count; d++) sum += dye_gain(scene, scene.dyes[d], lo);
  return sum;
}

Excitation dyes_sample(const CompiledScene& scene, std::uint32_t first_dye, std::uint32_t count, double lo, Random& random) {
  // A dye by its share of the gain.
  const double total = dyes_gain(scene, first_dye, count, lo);
  double left = random.next() * total, gain = 0;
  std::uint32_t chosen = first_dye;
  for (std::uint32_t d = first_dye; d < first_dye + count; d++) {
    const double g = dye_gain(scene, scene.dyes[d], lo);
    if (g <= 0) continue;
    chosen = d, gain = g;
    left -= g;
    if (left < 0) break;
  }
  if (gain <= 0) return {};

  // A wavelength that excites it.
  const layout::Dye& dye = scene.dyes[chosen];
  Excitation result;
  double pdf = 0;
  result.li = distribution_sample(scene, dye.excitation, random.next(), pdf);
  if (pdf > 0) result.weight = dye_kernel(scene, dye, result.li, lo) / (pdf * gain / total);
  return result;
}

namespace {

/// r(lo) times what the dyes leave of the light at lo.
double base_albedo(const CompiledScene& scene, const layout::Material& m, const SurfacePoint& point, Vec3d wo, Wavelength lo) {
  double albedo = m.albedo == STOKES_NONE ? 0 : color_eval(scene, m.albedo, point, wo, lo);
  if (m.type == layout::MATERIAL_FLUORESCENT) {
    double absorbed = 0;
    for (std::uint32_t d = m.first_dye; d < m.first_dye + m.dye_count; d++) absorbed += spectrum_eval(scene, scene.dyes[d].absorption, lo);
    albedo *= std::max(0.0, 1 - absorbed);
  }
  return albedo;
}

}  // namespace

DiffuseBranch diffuse_branch_sample(const CompiledScene& scene, const layout::Material& m, const SurfacePoint& point, Vec3d wo, Wavelength lo,
                                    Random& random) {
  const bool measured = m.type == layout::MATERIAL_RERADIATION;
  const double reflected = base_albedo(scene, m, point, wo, lo);
  double gain = 0;
  if (lo.channel < 0)
    gain = measured ? reradiation_gain(scene, scene.reradiations[m.first_dye], lo.nm) : dyes_gain(scene, m.first_dye, m.dye_count, lo.nm);
  if (gain + reflected <= 0) return {};

  const double probability = gain / (gain + reflected);
  if (!(random.next() < probability)) return {false, lo, reflected / (1 - probability)};
  const Excitation e = measured ? reradiation_sample(scene, scene.reradiations[m.first_dye], lo.nm, random.next())
                                : dyes_sample(scene, m.first_dye, m.dye_count, lo.nm, random);
  return {true, {e.li, -1}, e.weight / probability};
}

}  // namespace stokes::reference
