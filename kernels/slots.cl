// Slots: where few lanes need what is dear, their wavelengths are laid side by side, so that one pass over the lanes serves all wavelengths of
// LANES / WAVELENGTHS paths. Slot i * WAVELENGTHS + k is wavelength k of the i-th path in hand. Knows lanes, not what is looked up.
#ifndef STOKES_SLOTS_CL
#define STOKES_SLOTS_CL
#include "lanes.h"

// Whether wavelengths fit side by side at all; else they are served one by one.
#define STOKES_PACKS_SLOTS (LANES > 1 && WAVELENGTHS > 1 && LANES % WAVELENGTHS == 0)
#define STOKES_SLOT_PATHS (STOKES_PACKS_SLOTS ? LANES / WAVELENGTHS : 1)

typedef struct {
  uint lane[STOKES_SLOT_PATHS];
} SlotPaths;

/// Takes the next paths from the lanes `left`, which must not be 0; the last one repeats where there are too few.
STOKES_FN SlotPaths slots_take(uint* left) {
  SlotPaths s;
  uint j = 0u;
  STOKES_UNROLL for (int i = 0; i < STOKES_SLOT_PATHS; i++) {
    if (*left != 0u) j = lowest_lane(*left);
    *left &= *left - 1u;
    s.lane[i] = j;
  }
  return s;
}

/// A number of each path, in all of its slots.
STOKES_FN Real slots_of_real(const SlotPaths* s, const Real* x) {
  Real r = spread_real(x, s->lane[0]);
  STOKES_UNROLL for (int i = 1; i < STOKES_SLOT_PATHS; i++) r = lane_mask(ALL_LANE_BITS << (i * WAVELENGTHS)) ? spread_real(x, s->lane[i]) : r;
  return r;
}
STOKES_FN Int slots_of_int(const SlotPaths* s, const Int* x) {
  Int r = spread_int(x, s->lane[0]);
  STOKES_UNROLL for (int i = 1; i < STOKES_SLOT_PATHS; i++) r = lane_mask(ALL_LANE_BITS << (i * WAVELENGTHS)) ? spread_int(x, s->lane[i]) : r;
  return r;
}

/// A number of each path and wavelength.
STOKES_FN Real slots_of_spectrum(const SlotPaths* s, const Spectrum* x) {
  Real r = real(0.0f);
  STOKES_UNROLL for (int i = 0; i < STOKES_SLOT_PATHS; i++)
    FOR_EACH_WAVELENGTH(k) r = lane_mask(1u << (i * WAVELENGTHS + k)) ? spread_real(&x->v[k], s->lane[i]) : r;
  return r;
}

/// Hands the slots' numbers back to their paths; the other lanes of *x stay.
STOKES_FN void slots_return(const SlotPaths* s, Real slots, Spectrum* x) {
  STOKES_UNROLL for (int i = 0; i < STOKES_SLOT_PATHS; i++) {
    const Mask own = lane_mask(1u << s->lane[i]);
    FOR_EACH_WAVELENGTH(k) x->v[k] = own ? spread_real(&slots, (uint)(i * WAVELENGTHS + k)) : x->v[k];
  }
}

/// The number of each slot's wavelength.
STOKES_FN Int slots_wavelengths(void) {
  Int r = integer(0);
  STOKES_UNROLL for (int p = 1; p < LANES; p++) r = lane_mask(1u << p) ? integer(p % WAVELENGTHS) : r;
  return r;
}
#endif
