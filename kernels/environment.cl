// The environment image: its radiance in a direction, and directions drawn by its brightness. Knows its texels and cumulative tables.
#ifndef STOKES_ENVIRONMENT_CL
#define STOKES_ENVIRONMENT_CL
#include "texture.cl"

/// Position of a direction in the image: u to the right, v from the top, both in [0, 1]; the centre lies at -z of the image's frame.
STOKES_FN void environment_uv(const SceneView* view, Real3 d, Real* u, Real* v) {
  const __global float* m = view->environment->to_local;
  const Real x = fma(real(m[0]), d.x, fma(real(m[1]), d.y, real(m[2]) * d.z));
  const Real y = fma(real(m[3]), d.x, fma(real(m[4]), d.y, real(m[5]) * d.z));
  const Real z = fma(real(m[6]), d.x, fma(real(m[7]), d.y, real(m[8]) * d.z));
  *u = fma(atan2_real(x, -z), real(0.5f * STOKES_INV_PI), real(0.5f));
  *v = acos_real(y) * real(STOKES_INV_PI);
}

/// Radiance in direction d: bilinear between texel centres, repeating in u and clamped in v.
STOKES_FN Spectrum environment_radiance(const SceneView* view, Real3 d, const Spectrum* lambda) {
  const int width = (int)view->environment->width, height = (int)view->environment->height;
  Real u, v;
  environment_uv(view, d, &u, &v);
  const Real x = fma(u, real((float)width), real(-0.5f)), y = fma(v, real((float)height), real(-0.5f));
  const Real x0 = floor_real(x), y0 = floor_real(y);
  const Real fx = x - x0, fy = y - y0;
  const Int last = integer(width - 1);
  const Int column = max_int(min_int(to_int(x0), last), integer(-1));
  const Int left = column < integer(0) ? last : column, right = column >= last ? integer(0) : column + 1;
  const Int row = max_int(min_int(to_int(y0), integer(height - 1)), integer(-1));
  const Int top = max_int(row, integer(0)) * width, bottom = min_int(row + 1, integer(height - 1)) * width;
  const Int first = integer((int)view->environment->image_offset);
  Spectrum r = spectrum_constant(real(0.0f));
  add_texel(view, first + 4 * (top + left), (real(1.0f) - fx) * (real(1.0f) - fy), lambda, &r);
  add_texel(view, first + 4 * (top + right), fx * (real(1.0f) - fy), lambda, &r);
  add_texel(view, first + 4 * (bottom + left), (real(1.0f) - fx) * fy, lambda, &r);
  add_texel(view, first + 4 * (bottom + right), fx * fy, lambda, &r);
  const Real scale = real(view->environment->scale);
  if (SCENE_RGB) {
    FOR_EACH_WAVELENGTH(k) r.v[k] = r.v[k] * scale;
    return r;
  }
  const Spectrum illuminant = spectrum_eval(view, integer((int)view->environment->illuminant), lambda);
  FOR_EACH_WAVELENGTH(k) r.v[k] = r.v[k] * scale * illuminant.v[k];
  return r;
}

/// The last i in [0, count) with cdf[first + i] <= u.
STOKES_FN Int find_interval(const __global float* cdf, Int first, int count, Real u) {
  Int low = integer(0), high = integer(count);
  for (int size = count; size > 1; size = (size + 1) >> 1) {
    const Int middle = (low + high) >> 1;
    const Mask right = gather_real(cdf, first + middle) <= u;
    low = right ? middle : low;
    high = right ? high : middle;
  }
  return low;
}

/// Density per unit solid angle of environment_sample within a texel: the tables' probability over the texel's solid angle.
STOKES_FN Real environment_density(const SceneView* view, Int row, Int column, Real sin_theta) {
  const __global float* cdf = view->environment_cdf;
  const int width = (int)view->environment->width, height = (int)view->environment->height;
  const Real rows = gather_real(cdf, row + 1) - gather_real(cdf, row);
  const Int at = row * (width + 1) + column + (height + 1);
  const Real columns = gather_real(cdf, at + 1) - gather_real(cdf, at);
  const float pixels = (float)width * (float)height;
  return rows * columns * real(pixels * (0.5f * STOKES_INV_PI * STOKES_INV_PI)) / max_real(sin_theta, real(1e-9f));
}

STOKES_FN Real environment_pdf(const SceneView* view, Real3 d) {
  const int width = (int)view->environment->width, height = (int)view->environment->height;
  Real u, v, s, c;
  environment_uv(view, d, &u, &v);
  const Int column = max_int(min_int(to_int(u * (float)width), integer(width - 1)), integer(0));
  const Int row = max_int(min_int(to_int(v * (float)height), integer(height - 1)), integer(0));
  sincos_2pi(real(0.5f) * v, &s, &c);
  return environment_density(view, row, column, s);
}

/// Where u lies between the two ends of its interval, in [0, 1].
STOKES_FN Real interval_fraction(Real u, Real low, Real high) {
  return high > low ? clamp_real((u - low) / (high - low), real(0.0f), real(1.0f)) : real(0.5f);
}

/// A direction: the row by u1, the column by u2, uniform within the texel.
STOKES_FN Real3 environment_sample(const SceneView* view, Real u1, Real u2, Real* pdf) {
  const __global float* cdf = view->environment_cdf;
  const __global float* m = view->environment->to_local;
  const int width = (int)view->environment->width, height = (int)view->environment->height;
  const Int row = find_interval(cdf, integer(0), height, u1);
  const Int first = row * (width + 1) + (height + 1);
  const Int column = find_interval(cdf, first, width, u2);
  const Real fy = interval_fraction(u1, gather_real(cdf, row), gather_real(cdf, row + 1));
  const Real fx = interval_fraction(u2, gather_real(cdf, first + column), gather_real(cdf, first + column + 1));
  Real sin_phi, cos_phi, sin_theta, cos_theta;
  sincos_2pi(fma(to_real(column) + fx, real(1.0f / (float)width), real(-0.5f)), &sin_phi, &cos_phi);
  sincos_2pi((to_real(row) + fy) * (0.5f / (float)height), &sin_theta, &cos_theta);
  *pdf = environment_density(view, row, column, sin_theta);
  const Real x = sin_theta * sin_phi, y = cos_theta, z = -sin_theta * cos_phi;
  // The rotation's inverse is its transpose.
  return real3(fma(real(m[0]), x, fma(real(m[3]), y, real(m[6]) * z)), fma(real(m[1]), x, fma(real(m[4]), y, real(m[7]) * z)),
               fma(real(m[2]), x, fma(real(m[5]), y, real(m[8]) * z)));
}
#endif
