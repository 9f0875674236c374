// Spectrum tables, wavelength sampling and the sensor. Knows the tables of layout.h, not what a spectrum stands for.
// In RGB mode a "wavelength" is a channel number 0, 1, 2, so the same calls work on tables of three.
#ifndef STOKES_SPECTRUM_CL
#define STOKES_SPECTRUM_CL
#include "slots.cl"
#include "view.cl"

#ifndef SCENE_RGB
#define SCENE_RGB 0
#endif

/// The 1 nm cell of a wavelength and the position within it, in [0, 1].
STOKES_FN Int spectrum_cell(Real lambda, Real* f) {
  const Real x = max_real(lambda - real(STOKES_LAMBDA_MIN), real(0.0f));
  const Int c = min_int(to_int(x), integer(STOKES_SPECTRUM_CELLS - 1));
  *f = min_real(x - to_real(c), real(1.0f));
  return c;
}

/// Value of a table at one wavelength (nm; the channel number in RGB mode).
STOKES_FN Real spectrum_eval1(const SceneView* view, Int table, Real lambda) {
  if (SCENE_RGB) return gather_real(view->spectra, table * STOKES_RGB_STRIDE + to_int(lambda));
  Real f, a, b;
  const Int c = spectrum_cell(lambda, &f);
  gather_real2(view->spectra, table * STOKES_SPECTRUM_CELLS + c, &a, &b);
  return fma(f, b - a, a);
}

/// Values of a table at all wavelengths of the path.
STOKES_FN Spectrum spectrum_eval(const SceneView* view, Int table, const Spectrum* lambda) {
  Spectrum r;
  FOR_EACH_WAVELENGTH(k) {
    if (SCENE_RGB)
      r.v[k] = gather_real(view->spectra, table * STOKES_RGB_STRIDE + k);
    else
      r.v[k] = spectrum_eval1(view, table, lambda->v[k]);
  }
  return r;
}

/// Density per nm of distribution_sample at lambda.
STOKES_FN Real distribution_pdf(const SceneView* view, Int distribution, Real lambda) {
  const __global float* words = (const __global float*)view->distributions;
  const Int table = gather_int((const __global uint*)view->distributions, distribution * 4);
  return spectrum_eval1(view, table, lambda) / gather_real(words, distribution * 4 + 2);
}

/// Draws a wavelength (nm) with the density of the distribution, in the masked lanes; *pdf receives the density per nm, never 0 for u in (0, 1).
///
/// The cell is found in the cumulative table, the place within it by inverting the linear density. The result is kept inside
/// its cell, so that spectrum_eval1 reads the same cell there.
STOKES_FN Real distribution_sample(const SceneView* view, Int distribution, Real u, Mask mask, Real* pdf) {
  const Int first = distribution * (STOKES_CDF_STRIDE / 4);
  // The last c in [0, 499] that begins at or below u: mostly the guide's cell, or else one of those up to the next guide's.
  const Int guides = 4 * (first + STOKES_SPECTRUM_CELLS);
  const Int guide = min_int(to_int(u * (float)STOKES_CDF_GUIDES), integer(STOKES_CDF_GUIDES - 1));
  Int c = to_int(gather_real(view->cdfs, guides + guide));
  Real cell[4];
  gather_real4(view->cdfs, first + c, cell);
  const Mask beyond = mask & (u >= cell[1]) & (c < integer(STOKES_SPECTRUM_CELLS - 1));
  if (any(beyond)) {
    const Int next = min_int(guide + 1, integer(STOKES_CDF_GUIDES - 1));
    Int last = guide < next ? to_int(gather_real(view->cdfs, guides + next)) : integer(STOKES_SPECTRUM_CELLS - 1);
    last = beyond ? last : c;
    while (any(c < last)) {
      const Int middle = (c + last + 1) >> 1;
      const Mask above = gather_real(view->cdfs, 4 * (first + middle)) <= u;
      c = above ? middle : c;
      last = above ? last : middle - 1;
    }
    gather_real4(view->cdfs, first + c, cell);
  }
  const Real mass = cell[1] - cell[0];
  const Real x = mass > real(0.0f) ? min_real((u - cell[0]) / mass, real(1.0f)) : real(0.5f);
  const Real a = cell[2], b = cell[3];
  const Real root = a + sqrt_real(fma(x, b * b, (real(1.0f) - x) * (a * a)));
  const Real f = root > real(0.0f) ? x * (a + b) / root : real(0.5f);
  const Real start = to_real(c) + real(STOKES_LAMBDA_MIN);
  const Real end = as_real(as_integer(start + real(1.0f)) - 1);
  const Real lambda = min_real(start + f, end);
  *pdf = fma(lambda - start, b - a, a);
  return lambda;
}

/// frac(u + k / N), in (0, 1) as u is: the difference is exact, where the sum could round up to 1 and so to a wavelength without density.
STOKES_FN Real stratum(Real u, int k) {
  const Real x = u - real(1.0f - (float)k / (float)WAVELENGTHS);
  return x > real(0.0f) ? x : u + real((float)k / (float)WAVELENGTHS);
}

/// stratum of each slot's wavelength.
STOKES_FN Real slots_stratum(Real u) {
  const Real shift = to_real(slots_wavelengths()) * real(1.0f / (float)WAVELENGTHS);
  const Real x = u - (real(1.0f) - shift);
  return x > real(0.0f) ? x : u + shift;
}

/// The camera's wavelengths for the path's number u: wavelength k belongs to frac(u + k / WAVELENGTHS).
/// inverse_pdf receives 1 / p in nm. In RGB mode the channel numbers, and 1.
STOKES_FN void camera_wavelengths(const SceneView* view, Real u, Spectrum* lambda, Spectrum* inverse_pdf) {
  FOR_EACH_WAVELENGTH(k) {
    if (SCENE_RGB) {
      lambda->v[k] = real((float)k);
      inverse_pdf->v[k] = real(1.0f);
      continue;
    }
    const Real shifted = u + real((float)k / (float)WAVELENGTHS);
    const Real x = (shifted >= real(1.0f) ? shifted - real(1.0f) : shifted) * real((float)STOKES_CAMERA_KNOTS);
    const Int i = min_int(to_int(x), integer(STOKES_CAMERA_KNOTS - 1));
    const Real knot = gather_real(view->camera_knots, i);
    const Real width = gather_real(view->camera_knots, i + 1) - knot;
    lambda->v[k] = fma(x - to_real(i), width, knot);
    inverse_pdf->v[k] = width * real((float)STOKES_CAMERA_KNOTS);
  }
}

/// Linear sRGB response per unit radiance and nm at lambda. Not for RGB mode.
STOKES_FN Real3 sensor_rgb(const SceneView* view, Real lambda) {
  Real f, a[4], b[4];
  const Int c = spectrum_cell(lambda, &f);
  gather_real4(view->sensor, 2 * c, a);
  gather_real4(view->sensor, 2 * c + 1, b);
  return real3(fma(f, b[0] - a[0], a[0]), fma(f, b[1] - a[1], a[1]), fma(f, b[2] - a[2], a[2]));
}
#endif
