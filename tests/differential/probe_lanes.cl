// How the probes read and write arrays: LANES elements a work-item.
#ifndef STOKES_PROBE_LANES_CL
#define STOKES_PROBE_LANES_CL
#include "lanes.h"

/// The elements of this work-item.
STOKES_FN Int elements(void) {
  int ids[LANES];
  for (int j = 0; j < LANES; j++) ids[j] = (int)get_global_id(0) * LANES + j;
  return load_int(ids);
}
STOKES_FN void put(__global float* p, Int i, Real x) {
  float values[LANES];
  int ids[LANES];
  store_real(x, values), store_int(i, ids);
  for (int j = 0; j < LANES; j++) p[ids[j]] = values[j];
}
#endif
