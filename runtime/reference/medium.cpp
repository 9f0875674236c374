// Free flights, scattering and fluorescent sources in homogeneous media. See medium.h.
#include "reference/medium.h"

#include <cmath>

#include "reference/fluorescence.h"

namespace stokes::reference {
namespace {

/// An ordinary flight: to the collision or to the surface, whichever comes first.
Flight collide(const MediumAt& m, double t_max, Wavelength w, Random& random) {
  if (m.sigma_t <= 0) return {Flight::End::Surface, t_max, 1, w};
  const double t = -std::log(1 - random.next()) / m.sigma_t;
  if (t >= t_max) return {Flight::End::Surface, t_max, 1, w};
  return {Flight::End::Scattering, t, m.sigma_s / m.sigma_t, w};
}

/// int of the transmittance over the segment: the length that a source on it seems to have.
double seen_length(double sigma_t, double t_max) {
  if (sigma_t <= 0) return t_max;
  return -std::expm1(-sigma_t * t_max) / sigma_t;
}

/// A place on the segment with the density transmittance / seen_length.
double sample_segment(double sigma_t, double t_max, double u) {
  if (sigma_t <= 0) return u * t_max;
  return -std::log1p(u * std::expm1(-sigma_t * t_max)) / sigma_t;
}

}  // namespace

MediumAt medium_at(const CompiledScene& scene, std::uint32_t medium, Wavelength w) {
  if (medium == 0) return {};
  const layout::Medium& m = scene.media[medium];
  const double g = m.flags & MEDIUM_ISOTROPIC ? 0 : spectrum_eval(scene, m.g, w);
  return {spectrum_eval(scene, m.sigma_t, w), spectrum_eval(scene, m.sigma_s, w), g, m.first_dye, w.channel < 0 ? m.dye_count : 0};
}

double transmittance(const CompiledScene& scene, std::uint32_t medium, double distance, Wavelength w) {
  const double sigma_t = medium_at(scene, medium, w).sigma_t;
  return sigma_t > 0 ? std::exp(-sigma_t * distance) : 1;
}

Flight medium_flight(const CompiledScene& scene, std::uint32_t medium, double t_max, Wavelength w, Random& random) {
  const MediumAt m = medium_at(scene, medium, w);
  if (m.dye_count == 0) return collide(m, t_max, w, random);

  // What the dyes along the segment could send back, against the one path that the ordinary flight goes on with.
  const double length = seen_length(m.sigma_t, t_max);
  const double source = dyes_gain(scene, m.first_dye, m.dye_count, w.nm) * length;
  if (!(source > 0) || !std::isfinite(source)) return collide(m, t_max, w, random);
  const double probability = source / (1 + source);
  if (!(random.next() < probability)) {
    Flight flight = collide(m, t_max, w, random);
    flight.weight /= 1 - probability;
    return flight;
  }

  // Transmittance over the density of t is the seen length.
  Flight flight;
  flight.end = Flight::End::Fluorescence;
  flight.t = sample_segment(m.sigma_t, t_max, random.next());
  const Excitation e = dyes_sample(scene, m.first_dye, m.dye_count, w.nm, random);
  flight.weight = e.weight * length / probability;
  flight.wavelength = {e.li, -1};
  return flight;
}

}  // namespace stokes::reference
