// The lane layer: LANES paths advance in lockstep in one work-item, and this is the only file that knows how many.
// Everything above it reads like scalar code with a mask; nothing above it may depend on the lane count.
//
// Build constants: LANES is 1 (GPUs), 8 or 16 (CPUs); WAVELENGTHS is 1, 3 (RGB mode), 4 or 8.
// The one rule that makes one source right for scalars (true = 1) and vectors (true = -1):
//   masks are only combined with & | ! and used in ?: , never in arithmetic, never with ~ && ||.
// Both branches of ?: must be lanes: write `m ? x : real(0.0f)`.
// Bits: no contraction, fma only where written, no reductions across lanes. So every lane count and every runtime that
// rounds division and square root correctly gives the same bits.
#ifndef STOKES_LANES_H
#define STOKES_LANES_H
#pragma OPENCL FP_CONTRACT OFF

#ifndef LANES
#define LANES 1
#endif
#ifndef WAVELENGTHS
#define WAVELENGTHS 4
#endif
#ifndef STOKES_X86
#define STOKES_X86 0
#endif

#define STOKES_FN static inline __attribute__((always_inline, unused))
#define STOKES_NOINLINE static __attribute__((noinline, unused))
// For large functions that are called once for many lanes: compilers take a third less time over the kernel when these stand apart. With one
// lane, on GPUs, what they are handed by pointer stays in registers only when they are inlined.
#if LANES > 1
#define STOKES_APART STOKES_NOINLINE
#else
#define STOKES_APART STOKES_FN
#endif
#define STOKES_JOIN_(a, b) a##b
#define STOKES_JOIN(a, b) STOKES_JOIN_(a, b)
#define STOKES_UNROLL _Pragma("unroll")

/// Index of the lowest set bit; x must not be 0.
STOKES_FN uint lowest_lane(uint x) {
#if STOKES_X86
  return (uint)__builtin_ctz(x);
#else
  return 31u - clz(x & (0u - x));
#endif
}

/// Bit k of the result is set where component k of an int8 mask (0 or -1) is true.
STOKES_FN uint mask_bits8(int8 m) {
#if STOKES_X86
  return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
  const int8 b = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 c = b.lo | b.hi;
  const int2 d = c.lo | c.hi;
  return (uint)(d.x | d.y);
#endif
}

#if LANES == 1
typedef float Real;
typedef int Int;
typedef uint Uint;
typedef int Mask;
#define STOKES_EACH_LANE(X) X(0)
#define LANE(v, k) (v)
#else
typedef STOKES_JOIN(float, LANES) Real;
typedef STOKES_JOIN(int, LANES) Int;
typedef STOKES_JOIN(uint, LANES) Uint;
typedef STOKES_JOIN(int, LANES) Mask;
#define LANE(v, k) (v).s##k
#if LANES == 8
#define STOKES_EACH_LANE(X) X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7)
#elif LANES == 16
#define STOKES_EACH_LANE(X) \
  X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7), X(8), X(9), X(a), X(b), X(c), X(d), X(e), X(f)
#else
#error "LANES must be 1, 8 or 16"
#endif
#endif

#define ALL_LANE_BITS ((1u << LANES) - 1u)

typedef struct {
  Real x, y, z;
} Real3;

/// One value per wavelength of the path (per colour channel in RGB mode).
typedef struct {
  Real v[WAVELENGTHS];
} Spectrum;

#define FOR_EACH_WAVELENGTH(k) STOKES_UNROLL for (int k = 0; k < WAVELENGTHS; k++)

// ---- One value in every lane ---------------------------------------------------------------------------------
STOKES_FN Real real(float x) { return (Real)(x); }
STOKES_FN Int integer(int x) { return (Int)(x); }
STOKES_FN Uint uinteger(uint x) { return (Uint)(x); }

// ---- Masks ---------------------------------------------------------------------------------------------------
// OpenCL's own any() looks at the sign bit, which a scalar `true` does not have.
#define any(m) any_lane(m)
#if LANES == 1
STOKES_FN Mask all_lanes(void) { return 1; }
STOKES_FN Mask no_lanes(void) { return 0; }
STOKES_FN uint lane_bits(Mask m) { return m ? 1u : 0u; }
STOKES_FN Mask lane_mask(uint bits) { return (int)(bits & 1u); }
STOKES_FN int any_lane(Mask m) { return m; }
#else
STOKES_FN Mask all_lanes(void) { return (Mask)(-1); }
STOKES_FN Mask no_lanes(void) { return (Mask)(0); }
#if LANES == 8
STOKES_FN uint lane_bits(Mask m) { return mask_bits8(m); }
STOKES_FN Mask lane_mask(uint bits) {
  return ((Int)((int)bits) & (Int)(1, 2, 4, 8, 16, 32, 64, 128)) != (Int)(0);
}
#else
STOKES_FN uint lane_bits(Mask m) { return mask_bits8(m.lo) | (mask_bits8(m.hi) << 8); }
STOKES_FN Mask lane_mask(uint bits) {
  return ((Int)((int)bits) &
          (Int)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768)) != (Int)(0);
}
#endif
STOKES_FN int any_lane(Mask m) { return lane_bits(m) != 0u; }
#endif

// ---- Conversions ---------------------------------------------------------------------------------------------
#if LANES == 1
STOKES_FN Real to_real(Int x) { return (float)x; }
STOKES_FN Int to_int(Real x) { return (int)x; }
STOKES_FN Real as_real(Int x) { return as_float(x); }
STOKES_FN Int as_integer(Real x) { return as_int(x); }
STOKES_FN Uint as_uint_lanes(Int x) { return (uint)x; }
STOKES_FN Int as_int_lanes(Uint x) { return (int)x; }
#else
/// Nearest float.
STOKES_FN Real to_real(Int x) { return STOKES_JOIN(convert_float, LANES)(x); }
/// Truncates; |x| must be below 2^31.
STOKES_FN Int to_int(Real x) { return STOKES_JOIN(convert_int, LANES)(x); }
/// The same bits as another type (`as_int` is taken by the language).
STOKES_FN Real as_real(Int x) { return STOKES_JOIN(as_float, LANES)(x); }
STOKES_FN Int as_integer(Real x) { return STOKES_JOIN(as_int, LANES)(x); }
STOKES_FN Uint as_uint_lanes(Int x) { return STOKES_JOIN(as_uint, LANES)(x); }
STOKES_FN Int as_int_lanes(Uint x) { return STOKES_JOIN(as_int, LANES)(x); }
#endif

// ---- Elementwise ---------------------------------------------------------------------------------------------
// min and max by comparison: the second argument where either is NaN, on every runtime.
STOKES_FN Real min_real(Real a, Real b) { return a < b ? a : b; }
STOKES_FN Real max_real(Real a, Real b) { return a > b ? a : b; }
STOKES_FN Real clamp_real(Real x, Real lo, Real hi) { return min_real(max_real(x, lo), hi); }
STOKES_FN Int min_int(Int a, Int b) { return a < b ? a : b; }
STOKES_FN Int max_int(Int a, Int b) { return a > b ? a : b; }
STOKES_FN Real abs_real(Real x) { return as_real(as_integer(x) & (Int)(0x7fffffff)); }
STOKES_FN Real floor_real(Real x) { return floor(x); }
/// Correctly rounded.
STOKES_FN Real sqrt_real(Real x) { return sqrt(x); }
/// |magnitude| with the sign of `sign`.
STOKES_FN Real copysign_real(Real magnitude, Real sign) {
  return as_real((as_integer(magnitude) & (Int)(0x7fffffff)) | (as_integer(sign) & (Int)((int)0x80000000u)));
}
/// False for NaN and infinities.
STOKES_FN Mask finite_real(Real x) { return (as_integer(x) & (Int)(0x7f800000)) != (Int)(0x7f800000); }

// ---- Lanes to and from private arrays of LANES elements ------------------------------------------------------
#if LANES == 1
STOKES_FN void store_real(Real x, float* p) { p[0] = x; }
STOKES_FN void store_int(Int x, int* p) { p[0] = x; }
STOKES_FN void store_uint(Uint x, uint* p) { p[0] = x; }
STOKES_FN Real load_real(const float* p) { return p[0]; }
STOKES_FN Int load_int(const int* p) { return p[0]; }
STOKES_FN Uint load_uint(const uint* p) { return p[0]; }
#else
STOKES_FN void store_real(Real x, float* p) { STOKES_JOIN(vstore, LANES)(x, 0, p); }
STOKES_FN void store_int(Int x, int* p) { STOKES_JOIN(vstore, LANES)(x, 0, p); }
STOKES_FN void store_uint(Uint x, uint* p) { STOKES_JOIN(vstore, LANES)(x, 0, p); }
STOKES_FN Real load_real(const float* p) { return STOKES_JOIN(vload, LANES)(0, p); }
STOKES_FN Int load_int(const int* p) { return STOKES_JOIN(vload, LANES)(0, p); }
STOKES_FN Uint load_uint(const uint* p) { return STOKES_JOIN(vload, LANES)(0, p); }
#endif

/// Component j of lanes that lie in memory, in every lane.
STOKES_FN Real spread_real(const Real* x, uint j) { return real(((const float*)x)[j]); }
STOKES_FN Int spread_int(const Int* x, uint j) { return integer(((const int*)x)[j]); }
STOKES_FN Uint spread_uint(const Uint* x, uint j) { return uinteger(((const uint*)x)[j]); }

// ---- Gathers: lane j reads element i_j. Every lane reads, so dead lanes need a valid index too ----------------
#define STOKES_GATHER_1(k) p[LANE(i, k)]
// Records of two or four are loaded whole, one per lane, and turned in registers: CPUs' own gather instructions are slower.
#define STOKES_LOAD_2(k) vload2((size_t)LANE(i, k), p)
#define STOKES_LOAD_4(k) vload4((size_t)LANE(i, k), p)
#define STOKES_ITEM_X(k) item[k].x
#define STOKES_ITEM_Y(k) item[k].y
#define STOKES_ITEM_Z(k) item[k].z
#define STOKES_ITEM_W(k) item[k].w
// The lane digits of vectors as numbers.
#if LANES == 1
#define STOKES_EACH_ITEM(X) X(0)
#elif LANES == 8
#define STOKES_EACH_ITEM(X) X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7)
#else
#define STOKES_EACH_ITEM(X) \
  X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7), X(8), X(9), X(10), X(11), X(12), X(13), X(14), X(15)
#endif

STOKES_FN Real gather_real(const __global float* p, Int i) { return (Real)(STOKES_EACH_LANE(STOKES_GATHER_1)); }
/// Elements 2 i and 2 i + 1.
STOKES_FN void gather_real2(const __global float* p, Int i, Real* a, Real* b) {
  const float2 item[LANES] = {STOKES_EACH_LANE(STOKES_LOAD_2)};
  *a = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_X));
  *b = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_Y));
}
/// Elements 4 i to 4 i + 3.
STOKES_FN void gather_real4(const __global float* p, Int i, Real* x4) {
  const float4 item[LANES] = {STOKES_EACH_LANE(STOKES_LOAD_4)};
  x4[0] = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_X));
  x4[1] = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_Y));
  x4[2] = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_Z));
  x4[3] = (Real)(STOKES_EACH_ITEM(STOKES_ITEM_W));
}
/// The same words read as integers.
STOKES_FN void gather_int4(const __global uint* p, Int i, Int* x4) {
  Real x[4];
  gather_real4((const __global float*)p, i, x);
  STOKES_UNROLL for (int k = 0; k < 4; k++) x4[k] = as_integer(x[k]);
}
#define STOKES_GATHER_INT(k) (int)p[LANE(i, k)]
STOKES_FN Int gather_int(const __global uint* p, Int i) { return (Int)(STOKES_EACH_LANE(STOKES_GATHER_INT)); }

// ---- Triples -------------------------------------------------------------------------------------------------
STOKES_FN Real3 real3(Real x, Real y, Real z) {
  Real3 r;
  r.x = x;
  r.y = y;
  r.z = z;
  return r;
}
/// Three consecutive floats from element i on.
STOKES_FN Real3 gather_real3(const __global float* p, Int i) {
  return real3(gather_real(p, i), gather_real(p, i + 1), gather_real(p, i + 2));
}
STOKES_FN Real3 add3(Real3 a, Real3 b) { return real3(a.x + b.x, a.y + b.y, a.z + b.z); }
STOKES_FN Real3 sub3(Real3 a, Real3 b) { return real3(a.x - b.x, a.y - b.y, a.z - b.z); }
STOKES_FN Real3 mul3(Real3 a, Real3 b) { return real3(a.x * b.x, a.y * b.y, a.z * b.z); }
STOKES_FN Real3 neg3(Real3 a) { return real3(-a.x, -a.y, -a.z); }
STOKES_FN Real3 scale3(Real3 a, Real t) { return real3(a.x * t, a.y * t, a.z * t); }
/// a + b t
STOKES_FN Real3 madd3(Real3 a, Real3 b, Real t) { return real3(fma(b.x, t, a.x), fma(b.y, t, a.y), fma(b.z, t, a.z)); }
STOKES_FN Real dot3(Real3 a, Real3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
STOKES_FN Real3 cross3(Real3 a, Real3 b) {
  return real3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x)));
}
/// a / |a|; a must not be zero.
STOKES_FN Real3 normalize3(Real3 a) { return scale3(a, real(1.0f) / sqrt_real(dot3(a, a))); }
STOKES_FN Real3 select3(Mask m, Real3 a, Real3 b) { return real3(m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z); }

// ---- Spectra -------------------------------------------------------------------------------------------------
STOKES_FN Spectrum spectrum_constant(Real x) {
  Spectrum r;
  FOR_EACH_WAVELENGTH(k) r.v[k] = x;
  return r;
}
STOKES_FN Spectrum select_spectrum(Mask m, Spectrum a, Spectrum b) {
  Spectrum r;
  FOR_EACH_WAVELENGTH(k) r.v[k] = m ? a.v[k] : b.v[k];
  return r;
}
#endif
