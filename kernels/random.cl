// Random numbers: one stream per path, keyed by seed, pixel and sample, so that an image depends on neither the lane count nor the
// order of the paths. Knows nothing of what the numbers are for.
#ifndef STOKES_RANDOM_CL
#define STOKES_RANDOM_CL
#include "lanes.h"

/// PCG-RXS-M-XS 32 (O'Neill 2014); the increment is odd and chosen per path.
typedef struct {
  Uint state, increment;
} Rng;

/// The stream of one path. `pixel` is the absolute index y * width + x.
///
/// Key and stream come from pcg3d (Jarzynski and Olano 2020), which mixes three words into three.
STOKES_FN Rng random_start(Uint pixel, Uint sample, uint seed) {
  Uint x = pixel * 1664525u + 1013904223u;
  Uint y = sample * 1664525u + 1013904223u;
  Uint z = uinteger(seed * 1664525u + 1013904223u);
  STOKES_UNROLL for (int round = 0; round < 2; round++) {
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
  }
  Rng rng;
  rng.state = x + z;
  rng.increment = (y << 1) | 1u;
  return rng;
}

/// 32 random bits per lane.
STOKES_FN Uint random_bits(Rng* rng) {
  const Uint old = rng->state;
  rng->state = old * 747796405u + rng->increment;
  const Uint word = ((old >> ((old >> 28) + 4u)) ^ old) * 277803737u;
  return (word >> 22) ^ word;
}

/// Uniform in (0, 1): odd multiples of 2^-24, so neither end is ever reached.
STOKES_FN Real random_next(Rng* rng) {
  const Int w = as_int_lanes(random_bits(rng) >> 9);
  return fma(to_real(w), real(1.1920928955078125e-7f), real(5.9604644775390625e-8f));
}

/// As random_next, but only the masked lanes' streams move on; the others get numbers that they must not use.
STOKES_FN Real random_next_where(Rng* rng, Mask mask) {
  const Uint before = rng->state;
  const Real u = random_next(rng);
  rng->state = mask ? rng->state : before;
  return u;
}
#endif
