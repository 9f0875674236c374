// Closest hits of a buffer of rays, one after another, for the traversal benchmark.
#include "traverse.cl"

// A ray is eight floats: origin, direction, tmax, unused.
__kernel void trace(const __global float* nodes, const __global float* leaves, uint chunk, const __global float* rays,
                    __global float* distances, __global uint* triangles) {
  const uint first = (uint)get_global_id(0) * chunk;
  for (uint i = first; i < first + chunk; i++) {
    const __global float* r = rays + 8 * i;
    TriangleHit hit = {r[6], 0.0f, 0.0f, STOKES_NONE};
    traverse_closest(nodes, leaves, (float3)(r[0], r[1], r[2]), (float3)(r[3], r[4], r[5]), STOKES_NONE, &hit);
    distances[i] = hit.index == STOKES_NONE ? -1.0f : hit.t;
    triangles[i] = hit.index;
  }
}
