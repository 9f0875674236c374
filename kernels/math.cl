// Elementary functions on lanes, made of exactly rounded operations only, so that they give the same bits on every runtime.
// Polynomials are those of Moshier's Cephes (single precision). Knows lanes, nothing of rendering.
#ifndef STOKES_MATH_CL
#define STOKES_MATH_CL
#include "lanes.h"

#define STOKES_PI 3.14159265358979f
#define STOKES_INV_PI 0.318309886183791f
#define STOKES_INV_4PI 0.0795774715459477f

STOKES_FN Real sqr(Real x) { return x * x; }
/// sqrt(max(x, 0)); 0 for NaN.
STOKES_FN Real safe_sqrt(Real x) { return sqrt_real(x > real(0.0f) ? x : real(0.0f)); }

/// x = 2^exponent (1 + f) with f in [sqrt(1/2) - 1, sqrt(2) - 1); log(1 + f) = f + rest.
STOKES_FN void log_parts(Real x, Real* exponent, Real* f, Real* rest) {
  const Int i = as_integer(x) - 0x3f3504f3;
  *exponent = to_real(i >> 23);
  *f = as_real((i & 0x007fffff) + 0x3f3504f3) - real(1.0f);
  const Real z = *f * *f;
  Real p = fma(real(7.0376836292e-2f), *f, real(-1.1514610310e-1f));
  p = fma(p, *f, real(1.1676998740e-1f));
  p = fma(p, *f, real(-1.2420140846e-1f));
  p = fma(p, *f, real(1.4249322787e-1f));
  p = fma(p, *f, real(-1.6668057665e-1f));
  p = fma(p, *f, real(2.0000714765e-1f));
  p = fma(p, *f, real(-2.4999993993e-1f));
  p = fma(p, *f, real(3.3333331174e-1f));
  *rest = fma(*f * z, p, real(-0.5f) * z);
}

#define STOKES_LN2_HI 0.693359375f
#define STOKES_LN2_LO -2.12194440e-4f

/// Natural logarithm, relative error below 2e-7 for normal x > 0; -infinity for x below 2^-126.
STOKES_FN Real log_real(Real x) {
  Real e, f, rest;
  log_parts(x, &e, &f, &rest);
  const Real y = fma(e, real(STOKES_LN2_HI), f + fma(e, real(STOKES_LN2_LO), rest));
  return x >= real(1.17549435e-38f) ? y : real(-INFINITY);
}

/// e^x, relative error below 2e-7; 0 below -87.3 (never subnormal), infinity above 88.37.
STOKES_FN Real exp_real(Real x) {
  const Real y = clamp_real(x, real(-87.3f), real(88.37f));
  const Real n = rint(y * real(1.44269504f));
  Real r = fma(n, real(-STOKES_LN2_HI), y);
  r = fma(n, real(-(STOKES_LN2_LO)), r);
  Real p = fma(real(1.9875691500e-4f), r, real(1.3981999507e-3f));
  p = fma(p, r, real(8.3334519073e-3f));
  p = fma(p, r, real(4.1665795894e-2f));
  p = fma(p, r, real(1.6666665459e-1f));
  p = fma(p, r, real(5.0000001201e-1f));
  p = fma(p, r * r, r) + real(1.0f);
  p = p * as_real((to_int(n) + 127) << 23);
  p = x < real(-87.3f) ? real(0.0f) : p;
  return x > real(88.37f) ? real(INFINITY) : p;
}

/// x^y for x >= 0; the logarithm is carried in two floats, so the relative error stays below 5e-7 for |y log x| < 80.
/// 0 for x below 2^-126 (and 1 for y = 0).
STOKES_FN Real pow_real(Real x, Real y) {
  Real e, f, rest;
  log_parts(x, &e, &f, &rest);
  rest = fma(e, real(STOKES_LN2_LO), rest);
  // s + s_low = e ln2_hi + f exactly (e ln2_hi is exact), then h + l = s + s_low + rest.
  const Real a = e * real(STOKES_LN2_HI);
  const Real s = a + f;
  const Real b = s - a;
  const Real s_low = (a - (s - b)) + (f - b);
  const Real h = s + rest;
  const Real l = (rest - (h - s)) + s_low;
  const Real p = y * h;
  const Real p_low = fma(y, h, -p) + y * l;
  const Real z = exp_real(p);
  const Real result = finite_real(z) ? fma(z, p_low, z) : z;
  const Mask zero = (x < real(1.17549435e-38f)) & (y != real(0.0f));
  return zero ? real(0.0f) : result;
}

/// sin and cos of r + q pi/2 for |r| <= pi/4.
STOKES_FN void sincos_quadrant(Real r, Int q, Real* s, Real* c) {
  const Real z = r * r;
  Real ps = fma(real(-1.9515295891e-4f), z, real(8.3321608736e-3f));
  ps = fma(ps, z, real(-1.6666654611e-1f));
  ps = fma(ps, z * r, r);
  Real pc = fma(real(2.443315711809948e-5f), z, real(-1.388731625493765e-3f));
  pc = fma(pc, z, real(4.166664568298827e-2f));
  pc = fma(pc, z * z, fma(real(-0.5f), z, real(1.0f)));
  const Mask odd = (q & 1) != integer(0);
  const Real a = odd ? pc : ps;
  const Real b = odd ? ps : pc;
  *s = as_real(as_integer(a) ^ ((q & 2) << 30));
  *c = as_real(as_integer(b) ^ (((q + 1) & 2) << 30));
}

/// Sine and cosine of 2 pi u, u in [-1000, 1000]; absolute error below 1e-7.
STOKES_FN void sincos_2pi(Real u, Real* s, Real* c) {
  const Real v = u * real(4.0f);
  const Real n = rint(v);
  const Real t = v - n;
  const Real r = fma(t, real(1.57079637f), t * real(-4.37113883e-8f));
  sincos_quadrant(r, to_int(n), s, c);
}

/// Sine and cosine of x radians, |x| < 1e5; absolute error below 1e-7.
STOKES_FN void sincos_real(Real x, Real* s, Real* c) {
  const Real n = rint(x * real(0.636619772f));
  Real r = fma(n, real(-1.57079637f), x);
  r = fma(n, real(4.37113883e-8f), r);
  r = fma(n, real(1.71512489e-15f), r);
  sincos_quadrant(r, to_int(n), s, c);
}
STOKES_FN Real sin_real(Real x) {
  Real s, c;
  sincos_real(x, &s, &c);
  return s;
}

/// Angle of the point (x, y) in [-pi, pi]; relative error below 4e-7; 0 for (0, 0).
STOKES_FN Real atan2_real(Real y, Real x) {
  const Real ax = abs_real(x), ay = abs_real(y);
  const Mask steep = ay > ax;
  const Real small = steep ? ax : ay;
  Real large = steep ? ay : ax;
  large = large > real(0.0f) ? large : real(1.0f);
  // atan(t) = pi/4 + atan((t - 1) / (t + 1)) above tan(pi/8), in one division.
  const Mask upper = small > real(0.414213562f) * large;
  const Real t = (upper ? small - large : small) / (upper ? small + large : large);
  const Real z = t * t;
  Real p = fma(real(8.05374449538e-2f), z, real(-1.38776856032e-1f));
  p = fma(p, z, real(1.99777106478e-1f));
  p = fma(p, z, real(-3.33329491539e-1f));
  Real r = fma(p * z, t, t);
  r = upper ? r + real(0.785398163f) : r;
  r = steep ? (real(1.57079637f) - r) - real(4.37113883e-8f) : r;
  r = x < real(0.0f) ? (real(3.14159274f) - r) - real(8.74227766e-8f) : r;
  return as_real(as_integer(r) | (as_integer(y) & (int)0x80000000u));
}

/// Arc cosine of x, clamped to [-1, 1]; relative error below 5e-7.
STOKES_FN Real acos_real(Real x) {
  return real(2.0f) * atan2_real(safe_sqrt(real(1.0f) - x), safe_sqrt(real(1.0f) + x));
}
#endif
