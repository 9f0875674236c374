// The film: finished paths become integers and join their pixel's sums, so that neither the order of paths nor the lane count changes a
// bit. Knows wavelengths and words, not how light got there. One path at a time: only few lanes finish together.
#ifndef STOKES_FILM_CL
#define STOKES_FILM_CL
#include "throughput.cl"

#define FILM_UNIT 16777216.0f  // alpha, albedo and normals are counted in 2^-24
#define FILM_LIMIT 4.611686e18f
// Whether the spectrum of what fluoresced is kept apart.
#define FILM_KEEPS_FLUORESCENT_BINS ((FILM_CHANNELS & FILM_FLUORESCENT_BINS) != 0 && FILM_SPECTRAL)
// The small integrators hand over R, G and B instead of radiance per wavelength.
#define FILM_TAKES_RGB (INTEGRATOR == INTEGRATOR_NORMALS || INTEGRATOR == INTEGRATOR_AO)

/// What all lanes' paths have to tell the film: radiance per camera wavelength, and what the first hit was.
typedef struct {
  float u[LANES];  // the number the camera's wavelengths came from
  float radiance[WAVELENGTHS][LANES];
  float fluorescence[WAVELENGTHS][LANES];  // the part that went through a fluorescent event
  float rgb[3][LANES];
  float alpha[LANES], depth[LANES];
  float albedo[3][LANES], normal[3][LANES];
} FilmSamples;

/// The nearest integer (even at halves); |value| at most FILM_LIMIT. Adding 2^23 leaves a float no fraction to keep.
STOKES_FN long film_round(float value) {
  const float shift = value < 0.0f ? -8388608.0f : 8388608.0f;
  const float rounded = (value + shift) - shift;
  return (long)(fabs(value) < 8388608.0f ? rounded : value);
}

/// Adds a number, in units of the word's quantum.
STOKES_FN void film_add_word(__global long* word, float value) { *word += film_round(value); }

/// Adds a square of at most 2^124 to 128 bits (low, high).
STOKES_FN void film_add_square(__global long* words, long x) {
  const ulong a = (ulong)(x < 0 ? -x : x);
  const ulong top = a >> 32, bottom = a & 0xffffffffu;
  const ulong cross = top * bottom;  // below 2^62
  const ulong square = bottom * bottom, low = square + (cross << 33);
  const ulong high = top * top + (cross >> 31) + (low < square ? 1u : 0u);
  const ulong sum = (ulong)words[0] + low;
  words[0] = (long)sum;
  words[1] += (long)(high + (sum < low ? 1u : 0u));
}

/// Whether a number is finite and not too large for a word; NaN is not.
STOKES_FN int film_accepts(float value) { return fabs(value) <= FILM_LIMIT; }

/// Camera wavelength k of u and 1 / pdf in nm: camera_wavelengths for one path.
STOKES_FN float film_wavelength(const SceneView* view, float u, int k, float* inverse_pdf) {
  const float shifted = u + (float)k / (float)WAVELENGTHS;
  const float x = (shifted >= 1.0f ? shifted - 1.0f : shifted) * (float)STOKES_CAMERA_KNOTS;
  const int i = min((int)x, STOKES_CAMERA_KNOTS - 1);
  const float knot = view->camera_knots[i];
  const float width = view->camera_knots[i + 1] - knot;
  *inverse_pdf = width * (float)STOKES_CAMERA_KNOTS;
  return fma(x - (float)i, width, knot);
}

/// Sensor response at lambda: linear sRGB.
STOKES_FN float4 film_response(const SceneView* view, float lambda) {
  const float x = max(lambda - STOKES_LAMBDA_MIN, 0.0f);
  const int c = min((int)x, STOKES_SPECTRUM_CELLS - 1);
  const float f = min(x - (float)c, 1.0f);
  const float4 a = vload4((size_t)(2 * c), view->sensor), b = vload4((size_t)(2 * c + 1), view->sensor);
  return fma((float4)(f), b - a, a);
}

/// Film radiance of one path: x, y, z are R, G, B; w is the energy over all wavelengths.
STOKES_FN float4 film_radiance(const SceneView* view, float u, const float* radiance) {
  if (SCENE_RGB) {
    const float r = radiance[0], g = radiance[1 % WAVELENGTHS], b = radiance[2 % WAVELENGTHS];
    return (float4)(r, g, b, 0.0f);
  }
  float4 sum = (float4)(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    float inverse_pdf;
    float4 response = film_response(view, film_wavelength(view, u, k, &inverse_pdf));
    response.w = 1.0f;
    sum = fma((float4)(radiance[k] * (inverse_pdf * (1.0f / (float)WAVELENGTHS))), response, sum);
  }
  return sum;
}

/// Radiance per nm into the spectral bins that the camera's wavelengths fall in.
STOKES_FN void film_add_bins(const SceneView* view, __global long* words, float u, const float* radiance, float per_quantum) {
  const float begin = view->scene->spectral_begin;
  const float per_nm = (float)view->scene->spectral_bins / (view->scene->spectral_end - begin);
  for (int k = 0; k < WAVELENGTHS; k++) {
    float inverse_pdf;
    const float place = (film_wavelength(view, u, k, &inverse_pdf) - begin) * per_nm;
    if (!(place >= 0.0f && place < (float)view->scene->spectral_bins)) continue;
    film_add_word(words + (int)place, radiance[k] * (inverse_pdf * (1.0f / (float)WAVELENGTHS)) * per_nm * per_quantum);
  }
}

/// The optional channels after the base words, in the order of layout.h; all of the sample's numbers have been accepted.
STOKES_FN void film_add_channels(const SceneView* view, __global long* words, const FilmSamples* s, uint j, const float* radiance,
                                 const float* fluorescence, float4 fluorescent, float per_quantum) {
  if (FILM_CHANNELS & FILM_ALBEDO)
    for (int i = 0; i < 3; i++) film_add_word(words++, s->albedo[i][j] * FILM_UNIT);
  if (FILM_CHANNELS & FILM_NORMAL)
    for (int i = 0; i < 3; i++) film_add_word(words++, s->normal[i][j] * FILM_UNIT);
  if (FILM_CHANNELS & FILM_DEPTH) film_add_word(words++, s->depth[j] * (1.0f / view->scene->depth_quantum));
  if (FILM_CHANNELS & FILM_FLUORESCENCE) {
    film_add_word(words++, fluorescent.x * per_quantum);
    film_add_word(words++, fluorescent.y * per_quantum);
    film_add_word(words++, fluorescent.z * per_quantum);
    film_add_word(words++, fluorescent.w * per_quantum);
  }
  if (FILM_SPECTRAL) film_add_bins(view, words, s->u[j], radiance, per_quantum);
  if (FILM_KEEPS_FLUORESCENT_BINS) film_add_bins(view, words + view->scene->spectral_bins, s->u[j], fluorescence, per_quantum);
}

/// Adds lane j's sample to its pixel. A sample with a number that is not finite or too large is counted and left out.
STOKES_FN void film_add(const SceneView* view, __global long* words, const FilmSamples* s, uint j) {
  float radiance[WAVELENGTHS], fluorescence[WAVELENGTHS];
  FOR_EACH_WAVELENGTH(k) radiance[k] = s->radiance[k][j];
  // The quantum is a power of two, so this scaling is exact.
  const float per_quantum = 1.0f / view->scene->film_quantum;
  const float4 rgb = FILM_TAKES_RGB ? (float4)(s->rgb[0][j], s->rgb[1][j], s->rgb[2][j], 0.0f) : film_radiance(view, s->u[j], radiance);
  const float4 scaled = rgb * per_quantum;
  float4 fluorescent = (float4)(0.0f);
  int valid = film_accepts(scaled.x) & film_accepts(scaled.y) & film_accepts(scaled.z);
  if (FILM_CHANNELS & FILM_FLUORESCENCE) {
    FOR_EACH_WAVELENGTH(k) fluorescence[k] = s->fluorescence[k][j];
    fluorescent = film_radiance(view, s->u[j], fluorescence);
    valid &= film_accepts(fluorescent.x * per_quantum) & film_accepts(fluorescent.y * per_quantum) &
             film_accepts(fluorescent.z * per_quantum) & film_accepts(fluorescent.w * per_quantum);
  }
  if (FILM_SPECTRAL) valid &= film_accepts(scaled.w * (float)view->scene->spectral_bins);
  if (FILM_KEEPS_FLUORESCENT_BINS) valid &= film_accepts(fluorescent.w * per_quantum * (float)view->scene->spectral_bins);
  if (FILM_CHANNELS & FILM_DEPTH) valid &= film_accepts(s->depth[j] * (1.0f / view->scene->depth_quantum));
  if (!valid) {
    words[11] += 1;
    return;
  }
  const long r = film_round(scaled.x), g = film_round(scaled.y), b = film_round(scaled.z);
  words[0] += r;
  words[1] += g;
  words[2] += b;
  film_add_square(words + 3, r);
  film_add_square(words + 5, g);
  film_add_square(words + 7, b);
  film_add_word(words + 9, s->alpha[j] * FILM_UNIT);
  words[10] += 1;
  if (FILM_CHANNELS | FILM_SPECTRAL) film_add_channels(view, words + FILM_BASE_WORDS, s, j, radiance, fluorescence, fluorescent, per_quantum);
}
#endif
