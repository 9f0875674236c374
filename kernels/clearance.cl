// How far a point surely is from every surface, or from all but the triangles of two leaves: random walks in dense media need not look for
// surfaces inside that ball, or only among those.
// Knows shapes only.
#ifndef STOKES_CLEARANCE_CL
#define STOKES_CLEARANCE_CL
#include "shapes.cl"
#include "traverse.cl"

/// Squared distances of a point to the boxes of a node's children, or (rows three apart) any other boxes.
STOKES_FN Wide box_distance2(Wide x0, Wide x1, Wide y0, Wide y1, Wide z0, Wide z1, float3 p) {
  const Wide dx = max_wide(max_wide(x0 - wide(p.x), wide(p.x) - x1), wide(0.0f));
  const Wide dy = max_wide(max_wide(y0 - wide(p.y), wide(p.y) - y1), wide(0.0f));
  const Wide dz = max_wide(max_wide(z0 - wide(p.z), wide(p.z) - z1), wide(0.0f));
  return fma(dx, dx, fma(dy, dy, dz * dz));
}

STOKES_FN Wide least3(Wide a, Wide b, Wide c) { return min_wide(min_wide(a, b), c); }
STOKES_FN Wide most3(Wide a, Wide b, Wide c) { return max_wide(max_wide(a, b), c); }

/// Lower bounds of the squared distances to the triangles of a block: the larger of the distances to box and plane.
STOKES_FN Wide block_distance2(const __global float* block, float3 p, WideMask* used) {
  const __global Wide* v = (const __global Wide*)block;
  const Wide box = box_distance2(least3(v[0], v[3], v[6]), most3(v[0], v[3], v[6]), least3(v[1], v[4], v[7]),
                                 most3(v[1], v[4], v[7]), least3(v[2], v[5], v[8]), most3(v[2], v[5], v[8]), p);
  const Wide e1x = v[3] - v[0], e1y = v[4] - v[1], e1z = v[5] - v[2];
  const Wide e2x = v[6] - v[0], e2y = v[7] - v[1], e2z = v[8] - v[2];
  const Wide nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z, nz = e1x * e2y - e1y * e2x;
  const Wide length2 = fma(nx, nx, fma(ny, ny, nz * nz));
  const Wide qx = wide(p.x) - v[0], qy = wide(p.y) - v[1], qz = wide(p.z) - v[2];
  const Wide height = fma(nx, qx, fma(ny, qy, nz * qz));
  // What rounding may have added to the height: a few units of its terms.
  const Wide slack = 1e-6f * fma(fabs(nx), fabs(qx), fma(fabs(ny), fabs(qy), fabs(nz) * fabs(qz)));
  const Wide above = max_wide(fabs(height) - slack, wide(0.0f));
  *used = length2 > wide(0.0f);
  return max_wide(box, above * above / length2);
}

/// What is near a point.
typedef struct {
  Real clear;         // no surface is nearer than this,
  Real known;         // nor than this, but for the triangles of two leaves of the tree
  Int first, second;  // the leaves, as their parents name them; -1: none
} Neighbourhood;

STOKES_FN Neighbourhood nothing_known(void) {
  Neighbourhood n;
  n.clear = n.known = real(0.0f);
  n.first = n.second = integer(-1);
  return n;
}

/// Lower bound of the squared distance from p to the triangles of a leaf, at most `limit`.
STOKES_FN float leaf_distance2(const __global float* leaves, uint leaf, float3 p, float limit) {
  const __global float* block = leaf_block(leaves, leaf);
  for (uint blocks = (leaf & 7u) + 1u; blocks > 0u; blocks--, block += BVH_WIDTH * 10) {
    WideMask used;
    const Wide distance2 = block_distance2(block, p, &used);
    uint closer = wide_bits((distance2 < wide(limit)) & used);
    if (closer == 0u) continue;
    float distances[BVH_WIDTH];
    STORE_WIDE(distance2, distances);
    for (; closer != 0u; closer &= closer - 1u) limit = fmin(limit, distances[lowest_lane(closer)]);
  }
  return limit;
}

/// The two nearest leaves (STOKES_NONE: there is none within `radius`), and lower bounds, at most `radius`, of the distances to the nearest
/// triangle (distance[0]) and to the nearest that is in neither leaf (distance[1]).
STOKES_NOINLINE void nearest_leaves(const __global float* nodes, const __global float* leaves, float3 p, float radius, float* distance, uint* leaf) {
  float first = radius * radius, second = first, others = first;
  leaf[0] = leaf[1] = STOKES_NONE;
  uint stack[STOKES_STACK];
  int top = 1;
  stack[0] = 0u;
  while (top > 0 && others > 0.0f) {
    const __global float* node = nodes + (ulong)stack[--top] * (BVH_WIDTH * 8);
    const __global Wide* rows = (const __global Wide*)node;
    const __global uint* children = (const __global uint*)(node + 6 * BVH_WIDTH);
    const Wide boxes = box_distance2(rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], p);
    for (uint near = wide_bits(boxes < wide(others)); near != 0u; near &= near - 1u) {
      const uint child = children[lowest_lane(near)];
      if (!(child & STOKES_LEAF_BIT)) {
        stack[top++] = child;
        continue;
      }
      const float found = leaf_distance2(leaves, child, p, others);
      if (found >= others) continue;
      others = fmin(others, fmax(found, second));
      if (found < first) {
        second = first, leaf[1] = leaf[0];
        first = found, leaf[0] = child;
      } else if (found < second) {
        second = found, leaf[1] = child;
      }
    }
  }
  distance[0] = sqrt(first) * 0.99999f;
  distance[1] = sqrt(others) * 0.99999f;
}

STOKES_FN Real quad_clearance(const __global Quad* quad, Real3 p) {
  const Vec3 c = quad->corner, n = quad->normal, du = quad->dual_u, dv = quad->dual_v;
  const Real3 q = real3(p.x - c.x, p.y - c.y, p.z - c.z);
  const Real height = abs_real(fma(q.x, real(n.x), fma(q.y, real(n.y), q.z * n.z)));
  const Real u = fma(q.x, real(du.x), fma(q.y, real(du.y), q.z * du.z));
  const Real v = fma(q.x, real(dv.x), fma(q.y, real(dv.y), q.z * dv.z));
  // Distance to the strips 0 <= u <= 1 and 0 <= v <= 1, whose widths are 1 / |dual|.
  const Real out_u = max_real(abs_real(u - 0.5f) - 0.5f, real(0.0f)) / sqrt(fma(du.x, du.x, fma(du.y, du.y, du.z * du.z)));
  const Real out_v = max_real(abs_real(v - 0.5f) - 0.5f, real(0.0f)) / sqrt(fma(dv.x, dv.x, fma(dv.y, dv.y, dv.z * dv.z)));
  const Real slack = (abs_real(q.x) + abs_real(q.y) + abs_real(q.z)) * 1e-6f;
  return max_real(max_real(height, max_real(out_u, out_v)) - slack, real(0.0f));
}

STOKES_FN Real sphere_clearance(const __global Sphere* sphere, Real3 p) {
  const Vec3 c = sphere->center;
  const Real3 q = real3(p.x - c.x, p.y - c.y, p.z - c.z);
  const Real distance = sqrt_real(dot3(q, q));
  return max_real(abs_real(distance - sphere->radius) - (distance + sphere->radius) * 1e-6f, real(0.0f));
}

/// In local space the surface is |q| = 1; a local distance is at most the world distance times the norm of to_local,
/// bounded by Frobenius' norm.
STOKES_FN Real ellipsoid_clearance(const __global Ellipsoid* ellipsoid, Real3 p) {
  const __global float* m = ellipsoid->to_local;
  const Real3 q = transform3x4(m, p, 1.0f);
  const Real distance = sqrt_real(dot3(q, q));
  float norm2 = 0.0f;
  for (int row = 0; row < 12; row += 4) norm2 += fma(m[row], m[row], fma(m[row + 1], m[row + 1], m[row + 2] * m[row + 2]));
  const Real slack = (distance + (fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + 1.0f)) * 2e-6f;
  return max_real(abs_real(distance - 1.0f) - slack, real(0.0f)) / sqrt(norm2);
}

/// What is nearer to p than max_radius; nothing is known where m is false.
STOKES_FN Neighbourhood look_around(const SceneView* view, Real3 p, Real max_radius, Mask m) {
  Neighbourhood n = nothing_known();
  Real best = m ? max_radius : real(0.0f);
  if (SCENE_HAS_QUADS)
    for (int i = 0; i < (int)view->scene->quad_count; i++) best = min_real(quad_clearance(view->quads + i, p), best);
  if (SCENE_HAS_SPHERES)
    for (int i = 0; i < (int)view->scene->sphere_count; i++) best = min_real(sphere_clearance(view->spheres + i, p), best);
  if (SCENE_HAS_ELLIPSOIDS)
    for (int i = 0; i < (int)view->scene->ellipsoid_count; i++)
      best = min_real(ellipsoid_clearance(view->ellipsoids + i, p), best);
  n.clear = n.known = best;
  if (SCENE_HAS_TRIANGLES) {
    float xs[LANES], ys[LANES], zs[LANES], clear[LANES], known[LANES];
    int first[LANES], second[LANES];
    store_real(p.x, xs), store_real(p.y, ys), store_real(p.z, zs), store_real(best, known), store_real(best, clear);
    store_int(n.first, first), store_int(n.second, second);
    for (uint lanes = lane_bits(best > real(0.0f)); lanes != 0u; lanes &= lanes - 1u) {
      const uint j = lowest_lane(lanes);
      float distance[2];
      uint leaf[2];
      nearest_leaves(view->bvh_nodes, view->bvh_leaves, (float3)(xs[j], ys[j], zs[j]), known[j], distance, leaf);
      clear[j] = distance[0], known[j] = distance[1];
      first[j] = (int)leaf[0], second[j] = (int)leaf[1];
    }
    n.clear = load_real(clear), n.known = load_real(known);
    n.first = load_int(first), n.second = load_int(second);
  }
  return n;
}
#endif
