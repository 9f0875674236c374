// Marble's gradient noise, as layout.h defines it. Knows points only.
#ifndef STOKES_NOISE_CL
#define STOKES_NOISE_CL
#include "math.cl"

/// The gradient at a lattice point times the offset (x, y, z) from it.
STOKES_FN Real lattice_noise(Int i, Int j, Int k, Real x, Real y, Real z) {
  Uint h = (as_uint_lanes(i) * 73856093u) ^ (as_uint_lanes(j) * 19349663u) ^ (as_uint_lanes(k) * 83492791u);
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  h ^= h >> 16;
  const Real gz = real(1.0f) - (to_real(as_int_lanes(h & 0xffffu)) + real(0.5f)) * (2.0f / 65536.0f);
  Real s, c;
  sincos_2pi((to_real(as_int_lanes(h >> 16)) + real(0.5f)) * (1.0f / 65536.0f), &s, &c);
  const Real r = safe_sqrt(real(1.0f) - gz * gz);
  return fma(r * c, x, fma(r * s, y, gz * z));
}

STOKES_FN Real hermite(Real t) { return t * t * (real(3.0f) - real(2.0f) * t); }
STOKES_FN Real mix_real(Real a, Real b, Real t) { return fma(t, b - a, a); }

STOKES_NOINLINE Real gradient_noise(Real x, Real y, Real z) {
  const Real fx = floor_real(x), fy = floor_real(y), fz = floor_real(z);
  const Int i = to_int(fx), j = to_int(fy), k = to_int(fz);
  x -= fx;
  y -= fy;
  z -= fz;
  Real corner[8];
  for (int n = 0; n < 8; n++) {
    const int a = n & 1, b = (n >> 1) & 1, c = n >> 2;
    corner[n] = lattice_noise(i + a, j + b, k + c, x - (float)a, y - (float)b, z - (float)c);
  }
  const Real u = hermite(x), v = hermite(y), w = hermite(z);
  const Real low = mix_real(mix_real(corner[0], corner[1], u), mix_real(corner[2], corner[3], u), v);
  const Real high = mix_real(mix_real(corner[4], corner[5], u), mix_real(corner[6], corner[7], u), v);
  return mix_real(low, high, w);
}

/// |sum of seven octaves|
STOKES_FN Real turbulence(Real3 p) {
  Real sum = real(0.0f);
  float weight = 1.0f, frequency = 1.0f;
  for (int octave = 0; octave < 7; octave++) {
    sum = fma(real(weight), gradient_noise(p.x * frequency, p.y * frequency, p.z * frequency), sum);
    weight *= 0.5f;
    frequency *= 2.0f;
  }
  return abs_real(sum);
}
#endif
