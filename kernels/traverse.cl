// The BVH walk of one ray at a time, with the BVH_WIDTH children of a node (and the triangles of a leaf block) side by side in one vector.
// Knows boxes and triangles, not surfaces or lanes.
//
// No ray slips through the edges and vertices of a closed mesh:
// - A triangle's vertices are moved into the ray's own sheared frame, each by arithmetic that sees that vertex alone (Woop, Benthin
//   and Wald 2013). An edge function is a difference of two products, each rounded once: rounding is monotone, so its sign is
//   right or it is zero, and the neighbour across the edge computes the exact opposite. Zero counts as inside for both. A fused
//   multiply-add would break this; contraction is off and none is written there.
// - Boxes are tested as if grown by more than the rounding of the slabs and of the shear.
#ifndef STOKES_TRAVERSE_CL
#define STOKES_TRAVERSE_CL
#include "bvh_ray.cl"

// Enough for 85 levels, the deepest tree that the builder makes.
#if BVH_WIDTH == 8
#define STOKES_STACK 608
#elif BVH_WIDTH == 4
#define STOKES_STACK 264
#elif BVH_WIDTH == 2
#define STOKES_STACK 96
#else
#error "BVH_WIDTH must be 8, 4 or 2"
#endif

/// The nearest triangle so far; index STOKES_NONE: none.
typedef struct {
  float t, b1, b2;
  uint index;
} TriangleHit;

/// The children whose boxes the ray meets before `limit`, as bits; *near receives the distances at which it enters them.
STOKES_FN uint meet_boxes(const __global float* node, const BvhRay* ray, float limit, Wide* near) {
  const __global Wide* rows = (const __global Wide*)node;
  const Wide nx = fma(rows[ray->near_row[0]], ray->near_inv[0], ray->near_add[0]);
  const Wide ny = fma(rows[2u + ray->near_row[1]], ray->near_inv[1], ray->near_add[1]);
  const Wide nz = fma(rows[4u + ray->near_row[2]], ray->near_inv[2], ray->near_add[2]);
  const Wide fx = fma(rows[ray->near_row[0] ^ 1u], ray->far_inv[0], ray->far_add[0]);
  const Wide fy = fma(rows[2u + (ray->near_row[1] ^ 1u)], ray->far_inv[1], ray->far_add[1]);
  const Wide fz = fma(rows[4u + (ray->near_row[2] ^ 1u)], ray->far_inv[2], ray->far_add[2]);
  *near = max_wide(max_wide(nx, ny), max_wide(nz, wide(0.0f)));
  return wide_bits(*near <= min_wide(min_wide(fx, fy), min_wide(fz, wide(limit))));
}

/// Tests the triangles of one block against (0, limit), as bits; t and the weights of the second and third vertex follow.
STOKES_FN uint meet_triangles(const __global float* block, const BvhRay* ray, float limit, Wide* t, Wide* b1, Wide* b2) {
  const __global Wide* x = (const __global Wide*)block + ray->row_x;
  const __global Wide* y = (const __global Wide*)block + ray->row_y;
  const __global Wide* z = (const __global Wide*)block + ray->row_z;
  const Wide az = z[0] - ray->oz, bz = z[3] - ray->oz, cz = z[6] - ray->oz;
  const Wide ax = fma(ray->shear_x, az, x[0] - ray->ox), ay = fma(ray->shear_y, az, y[0] - ray->oy);
  const Wide bx = fma(ray->shear_x, bz, x[3] - ray->ox), by = fma(ray->shear_y, bz, y[3] - ray->oy);
  const Wide cx = fma(ray->shear_x, cz, x[6] - ray->ox), cy = fma(ray->shear_y, cz, y[6] - ray->oy);
  const Wide u = cx * by - cy * bx;
  const Wide v = ax * cy - ay * cx;
  const Wide w = bx * ay - by * ax;
  const Wide least = min_wide(min_wide(u, v), w), most = max_wide(max_wide(u, v), w);
  const uint inside = wide_bits((least >= wide(0.0f)) | (most <= wide(0.0f)));
  if (inside == 0u) return 0u;
  // A triangle seen edge-on has a zero sum, so t is not a number and fails the comparisons.
  const Wide inv = wide(1.0f) / (u + v + w);
  *t = fma(u, az, fma(v, bz, w * cz)) * (inv * wide(ray->inv_dz));
  *b1 = v * inv;
  *b2 = w * inv;
  return inside & wide_bits((*t > wide(0.0f)) & (*t < wide(limit)));
}

/// The first of a leaf's (leaf & 7) + 1 blocks of triangles.
STOKES_FN const __global float* leaf_block(const __global float* leaves, uint leaf) {
  return leaves + (ulong)((leaf & ~STOKES_LEAF_BIT) >> 3) * (BVH_WIDTH * 10);
}

/// Lowers *hit to the nearest triangle of a leaf.
STOKES_FN void leaf_closest(const __global float* leaves, uint leaf, const BvhRay* ray, uint exclude, TriangleHit* hit) {
  const __global float* block = leaf_block(leaves, leaf);
  for (uint blocks = (leaf & 7u) + 1u; blocks > 0u; blocks--, block += BVH_WIDTH * 10) {
    Wide t, b1, b2;
    uint found = meet_triangles(block, ray, hit->t, &t, &b1, &b2);
    if (found == 0u) continue;
    float ts[BVH_WIDTH], b1s[BVH_WIDTH], b2s[BVH_WIDTH];
    STORE_WIDE(t, ts);
    STORE_WIDE(b1, b1s);
    STORE_WIDE(b2, b2s);
    for (; found != 0u; found &= found - 1u) {
      const uint k = lowest_lane(found);
      const uint index = as_uint(block[9 * BVH_WIDTH + k]);
      if (ts[k] < hit->t && index != exclude) {
        hit->t = ts[k];
        hit->b1 = b1s[k];
        hit->b2 = b2s[k];
        hit->index = index;
      }
    }
  }
}

STOKES_FN int leaf_any(const __global float* leaves, uint leaf, const BvhRay* ray, uint exclude, float limit) {
  const __global float* block = leaf_block(leaves, leaf);
  for (uint blocks = (leaf & 7u) + 1u; blocks > 0u; blocks--, block += BVH_WIDTH * 10) {
    Wide t, b1, b2;
    for (uint found = meet_triangles(block, ray, limit, &t, &b1, &b2); found != 0u; found &= found - 1u)
      if (as_uint(block[9 * BVH_WIDTH + lowest_lane(found)]) != exclude) return 1;
  }
  return 0;
}

// A stack entry holds the distance in its high and the child in its low word: distances are not negative, so the
// order of the entries as integers is the order of the distances.
STOKES_FN ulong stack_entry(float near, uint child) { return ((ulong)as_uint(near) << 32) | child; }
STOKES_FN float entry_near(ulong entry) { return as_float((uint)(entry >> 32)); }

/// Asks for the first lines of a child that will be visited soon: walks through large trees wait for memory more than anything.
STOKES_FN void prefetch_child(const __global float* nodes, const __global float* leaves, uint child) {
#if STOKES_X86
  const __global float* first = (child & STOKES_LEAF_BIT) ? leaf_block(leaves, child) : nodes + (ulong)child * (BVH_WIDTH * 8);
  STOKES_UNROLL for (int line = 0; line < 4; line++) __builtin_prefetch((const void*)(ulong)(first + 16 * line));
#else
  (void)nodes, (void)leaves, (void)child;
#endif
}

/// Pushes the met children (at least two) so that the nearest is on top, and returns the new top.
STOKES_FN int push_sorted(const __global float* nodes, const __global float* leaves, ulong* stack, int top, uint met,
                          const Wide* near, const __global uint* children) {
  float nears[BVH_WIDTH];
  STORE_WIDE(*near, nears);
  const int bottom = top;
  for (; met != 0u; met &= met - 1u) {
    const uint k = lowest_lane(met);
    const ulong entry = stack_entry(nears[k], children[k]);
    prefetch_child(nodes, leaves, children[k]);
    int i = top++;
    for (; i > bottom && stack[i - 1] < entry; i--) stack[i] = stack[i - 1];
    stack[i] = entry;
  }
  return top;
}

/// Lowers *hit (whose t is the ray's end) to the nearest triangle other than `exclude` on lane j's ray, below the nodes or leaves `start`
/// (0: the root) and `second` (STOKES_NONE: only the first).
STOKES_NOINLINE void traverse_closest(const __global float* nodes, const __global float* leaves, const BvhRays* rays, uint j,
                                      uint exclude, uint start, uint second, TriangleHit* hit) {
  BvhRay ray;
  pick_ray(rays, j, &ray);
  ulong stack[STOKES_STACK];
  int top = 0;
  uint current = start;
  if (second != STOKES_NONE) stack[top++] = stack_entry(0.0f, second);
  hit->t = hit->t < STOKES_FAR ? hit->t : STOKES_FAR;
  for (;;) {
    // Descend to a leaf along the nearest children.
    while (!(current & STOKES_LEAF_BIT)) {
      const __global float* node = nodes + (ulong)current * (BVH_WIDTH * 8);
      const __global uint* children = (const __global uint*)(node + 6 * BVH_WIDTH);
      Wide near;
      const uint met = meet_boxes(node, &ray, hit->t, &near);
      if (met == 0u) break;
      if ((met & (met - 1u)) == 0u) {
        current = children[lowest_lane(met)];
        continue;
      }
      if (BVH_WIDTH == 2) {
        const int swap = near.s1 < near.s0;
        stack[top++] = swap ? stack_entry(near.s0, children[0]) : stack_entry(near.s1, children[1]);
        current = swap ? children[1] : children[0];
        continue;
      }
      top = push_sorted(nodes, leaves, stack, top, met, &near, children) - 1;
      current = (uint)stack[top];
    }
    if (current & STOKES_LEAF_BIT) leaf_closest(leaves, current, &ray, exclude, hit);
    // Take the next subtree that is not beyond the hit.
    do {
      if (top == 0) return;
      top--;
    } while (entry_near(stack[top]) > hit->t);
    current = (uint)stack[top];
  }
}

/// 1 if any triangle other than `exclude` lies in (0, limit) on lane j's ray.
STOKES_NOINLINE int traverse_any(const __global float* nodes, const __global float* leaves, const BvhRays* rays, uint j, uint exclude,
                                 float limit) {
  BvhRay ray;
  pick_ray(rays, j, &ray);
  uint stack[STOKES_STACK];
  int top = 1;
  stack[0] = 0u;
  limit = limit < STOKES_FAR ? limit : STOKES_FAR;
  while (top > 0) {
    const uint current = stack[--top];
    if (current & STOKES_LEAF_BIT) {
      if (leaf_any(leaves, current, &ray, exclude, limit)) return 1;
      continue;
    }
    const __global float* node = nodes + (ulong)current * (BVH_WIDTH * 8);
    const __global uint* children = (const __global uint*)(node + 6 * BVH_WIDTH);
    Wide near;
    for (uint met = meet_boxes(node, &ray, limit, &near); met != 0u; met &= met - 1u)
      stack[top++] = children[lowest_lane(met)];
  }
  return 0;
}
#endif
