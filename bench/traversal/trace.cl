// Closest hits of a buffer of rays, one after another, for the traversal benchmark.
#include "traverse.cl"

// A ray is eight floats: origin, direction, tmax, unused.
__kernel void trace(const __global float* nodes, const __global float* leaves, uint chunk, const __global float* rays,
                    __global float* distances, __global uint* triangles) {
  const uint first = (uint)get_global_id(0) * chunk;
  for (uint i = first; i < first + chunk; i++) {
    const __global float* r = rays + 8 * i;
    TriangleHit hit = {r[6], 0.0f, 0.0f, STOKES_NONE};
    const Real3 o = real3(real(r[0]), real(r[1]), real(r[2])), d = real3(real(r[3]), real(r[4]), real(r[5]));
    const BvhSlabs slabs = prepare_slabs(o, d);
    BvhRays prepared;
    prepare_rays(&slabs, o, d, &prepared);
    traverse_closest(nodes, leaves, &prepared, 0u, STOKES_NONE, 0u, STOKES_NONE, &hit);
    distances[i] = hit.index == STOKES_NONE ? -1.0f : hit.t;
    triangles[i] = hit.index;
  }
}
