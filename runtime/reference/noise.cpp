// The noise behind marble, as layout.h defines it. See texture.h.
#include <cmath>

#include "reference/sampling.h"
#include "reference/texture.h"

namespace stokes::reference {
namespace {

Vec3d lattice_gradient(std::int64_t i, std::int64_t j, std::int64_t k) {
  std::uint32_t h = static_cast<std::uint32_t>(i) * 73856093u ^ static_cast<std::uint32_t>(j) * 19349663u ^ static_cast<std::uint32_t>(k) * 83492791u;
  h ^= h >> 16, h *= 0x7feb352du;
  h ^= h >> 15, h *= 0x846ca68bu;
  h ^= h >> 16;
  return direction_at(1 - 2 * ((h & 0xffffu) + 0.5) / 65536, ((h >> 16) + 0.5) / 65536);
}

double hermite(double t) { return t * t * (3 - 2 * t); }

}  // namespace

double noise(Vec3d p) {
  const Vec3d base = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3d f = p - base;
  double sum = 0;
  for (int corner = 0; corner < 8; corner++) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const Vec3d gradient = lattice_gradient(std::int64_t(base.x) + i, std::int64_t(base.y) + j, std::int64_t(base.z) + k);
    const Vec3d offset = f - Vec3d{double(i), double(j), double(k)};
    const double weight = (i ? hermite(f.x) : 1 - hermite(f.x)) * (j ? hermite(f.y) : 1 - hermite(f.y)) * (k ? hermite(f.z) : 1 - hermite(f.z));
    sum += weight * dot(gradient, offset);
  }
  return sum;
}

double turbulence(Vec3d p) {
  double sum = 0, weight = 1;
  for (int octave = 0; octave < 7; octave++) {
    sum += weight * noise(p);
    weight *= 0.5;
    p = p * 2;
  }
  return std::abs(sum);
}

}  // namespace stokes::reference
