// Rays made ready for the BVH: all lanes at once, then picked one by one. Knows boxes, not trees of them or triangles.
#ifndef STOKES_BVH_RAY_CL
#define STOKES_BVH_RAY_CL
#include "lanes.h"
#include "layout.h"

#ifndef BVH_WIDTH
#define BVH_WIDTH 8
#endif

typedef STOKES_JOIN(float, BVH_WIDTH) Wide;
typedef STOKES_JOIN(int, BVH_WIDTH) WideMask;
#define STORE_WIDE(x, p) STOKES_JOIN(vstore, BVH_WIDTH)(x, 0, p)

/// Bit k is set where component k is true.
STOKES_FN uint wide_bits(WideMask m) {
#if BVH_WIDTH == 8
  return mask_bits8(m);
#elif BVH_WIDTH == 4 && STOKES_X86
  return (uint)__builtin_ia32_movmskps(as_float4(m));
#elif BVH_WIDTH == 4
  const int4 b = m & (int4)(1, 2, 4, 8);
  const int2 c = b.lo | b.hi;
  return (uint)(c.x | c.y);
#else
  return (uint)((m.x & 1) | (m.y & 2));
#endif
}
STOKES_FN Wide wide(float x) { return (Wide)(x); }
STOKES_FN Wide min_wide(Wide a, Wide b) { return a < b ? a : b; }
STOKES_FN Wide max_wide(Wide a, Wide b) { return a > b ? a : b; }

/// A ray prepared for boxes and triangles.
typedef struct {
  // Slabs: distance to a plane b is fma(b, inv, add), rounded towards a longer interval.
  Wide near_inv[3], near_add[3], far_inv[3], far_add[3];
  uint near_row[3];  // 0: the minimum is met first, 1: the maximum
  // Shear: axis z is where |d| is largest.
  uint row_x, row_y, row_z;
  Wide ox, oy, oz, shear_x, shear_y;
  float inv_dz;
} BvhRay;

/// The slabs of all lanes' rays.
typedef struct {
  Real near_inv[3], near_add[3], far_inv[3], far_add[3];
} BvhSlabs;

/// The rays of all lanes, prepared together, to be picked one by one.
typedef struct {
  float near_inv[3][LANES], near_add[3][LANES], far_inv[3][LANES], far_add[3][LANES];
  float o[3][LANES], shear_x[LANES], shear_y[LANES], inv_dz[LANES];
  int row_z[LANES];
} BvhRays;

// The error of a slab distance is a few units of 2^-24, relative to the distance and to the origin's own coordinate.
// Both are covered fourfold; the floor serves rays that start at zero and run along an axis.
#define STOKES_SLAB_RELATIVE 9.5367431640625e-7f
#define STOKES_SLAB_ORIGIN 2.384185791015625e-7f
#define STOKES_SLAB_FLOOR 1e-12f
#define STOKES_FAR 1e18f

STOKES_FN void prepare_slab(BvhSlabs* slabs, int axis, Real o, Real d, Real pad) {
  const Real inv = real(1.0f) / (abs_real(d) > real(1e-24f) ? d : (d < real(0.0f) ? real(-1e-24f) : real(1e-24f)));
  const Real far_inv = inv * real(1.0f + STOKES_SLAB_RELATIVE);
  const Real slack = pad * abs_real(inv);
  slabs->near_inv[axis] = inv;
  slabs->near_add[axis] = -(o * inv) - slack;
  slabs->far_inv[axis] = far_inv;
  slabs->far_add[axis] = slack - o * far_inv;
}

STOKES_FN BvhSlabs prepare_slabs(Real3 o, Real3 d) {
  BvhSlabs slabs;
  const Real reach = max_real(max_real(abs_real(o.x), abs_real(o.y)), abs_real(o.z));
  const Real pad = max_real(reach * real(STOKES_SLAB_ORIGIN), real(STOKES_SLAB_FLOOR));
  prepare_slab(&slabs, 0, o.x, d.x, pad);
  prepare_slab(&slabs, 1, o.y, d.y, pad);
  prepare_slab(&slabs, 2, o.z, d.z, pad);
  return slabs;
}

/// d need not be unit, but must not be zero.
STOKES_FN void prepare_rays(const BvhSlabs* slabs, Real3 o, Real3 d, BvhRays* rays) {
  STOKES_UNROLL for (int axis = 0; axis < 3; axis++) {
    store_real(slabs->near_inv[axis], rays->near_inv[axis]);
    store_real(slabs->near_add[axis], rays->near_add[axis]);
    store_real(slabs->far_inv[axis], rays->far_inv[axis]);
    store_real(slabs->far_add[axis], rays->far_add[axis]);
  }
  const Real ax = abs_real(d.x), ay = abs_real(d.y), az = abs_real(d.z);
  const Mask z_is_x = (ax > ay) & (ax > az);
  const Mask z_is_y = !z_is_x & (ay > az);
  const Real3 p = select3(z_is_x, real3(o.y, o.z, o.x), select3(z_is_y, real3(o.z, o.x, o.y), o));
  const Real3 v = select3(z_is_x, real3(d.y, d.z, d.x), select3(z_is_y, real3(d.z, d.x, d.y), d));
  const Real inv_dz = real(1.0f) / v.z;
  store_int(z_is_x ? integer(0) : (z_is_y ? integer(1) : integer(2)), rays->row_z);
  store_real(p.x, rays->o[0]);
  store_real(p.y, rays->o[1]);
  store_real(p.z, rays->o[2]);
  store_real(-(v.x * inv_dz), rays->shear_x);
  store_real(-(v.y * inv_dz), rays->shear_y);
  store_real(inv_dz, rays->inv_dz);
}

/// The ray of lane j.
STOKES_FN void pick_ray(const BvhRays* rays, uint j, BvhRay* ray) {
  STOKES_UNROLL for (int axis = 0; axis < 3; axis++) {
    ray->near_row[axis] = rays->near_inv[axis][j] < 0.0f ? 1u : 0u;
    ray->near_inv[axis] = wide(rays->near_inv[axis][j]);
    ray->near_add[axis] = wide(rays->near_add[axis][j]);
    ray->far_inv[axis] = wide(rays->far_inv[axis][j]);
    ray->far_add[axis] = wide(rays->far_add[axis][j]);
  }
  ray->row_z = (uint)rays->row_z[j];
  ray->row_x = ray->row_z == 2u ? 0u : ray->row_z + 1u;
  ray->row_y = ray->row_z == 0u ? 2u : ray->row_z - 1u;
  ray->ox = wide(rays->o[0][j]);
  ray->oy = wide(rays->o[1][j]);
  ray->oz = wide(rays->o[2][j]);
  ray->shear_x = wide(rays->shear_x[j]);
  ray->shear_y = wide(rays->shear_y[j]);
  ray->inv_dz = rays->inv_dz[j];
}

#if BVH_WIDTH == 8
STOKES_FN float least_of(float8 a) {
  const float4 b = a.lo < a.hi ? a.lo : a.hi;
  const float2 c = b.lo < b.hi ? b.lo : b.hi;
  return c.x < c.y ? c.x : c.y;
}
#endif

/// The lanes whose rays meet the box round the whole tree before `limit`; it saves the others the walk. The box's slabs round as those of the
/// root's children do, and they lie inside it, so no walk that would find anything is left out.
STOKES_FN Mask meet_tree(const __global float* nodes, const BvhSlabs* slabs, Real limit) {
#if BVH_WIDTH == 8
  const __global Wide* rows = (const __global Wide*)nodes;
  Real near = real(0.0f), far = limit;
  STOKES_UNROLL for (int axis = 0; axis < 3; axis++) {
    // An empty slot's box is a far point.
    const Wide most = rows[2 * axis + 1] < wide(1e29f) ? rows[2 * axis + 1] : wide(-1e30f);
    const Real low = real(least_of(rows[2 * axis])), high = real(-least_of(-most));
    const Mask backward = slabs->near_inv[axis] < real(0.0f);
    near = max_real(near, fma(backward ? high : low, slabs->near_inv[axis], slabs->near_add[axis]));
    far = min_real(far, fma(backward ? low : high, slabs->far_inv[axis], slabs->far_add[axis]));
  }
  return near <= far;
#else
  // A narrow root is not dearer than its box.
  (void)nodes, (void)slabs, (void)limit;
  return all_lanes();
#endif
}
#endif
