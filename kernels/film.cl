// The film: finished paths become integers and join their pixel's sums, so that neither the order of paths nor the lane count changes a
// bit. Knows wavelengths and words, not how light got there. Only few lanes finish together, so samples wait until there are LANES of them.
#ifndef STOKES_FILM_CL
#define STOKES_FILM_CL
#include "throughput.cl"

#define FILM_UNIT 16777216.0f  // alpha, albedo and normals are counted in 2^-24
#define FILM_LIMIT 4.611686e18f
// Whether the spectrum of what fluoresced is kept apart.
#define FILM_KEEPS_FLUORESCENT_BINS ((FILM_CHANNELS & FILM_FLUORESCENT_BINS) != 0 && FILM_SPECTRAL)
// The small integrators hand over R, G and B instead of radiance per wavelength.
#define FILM_TAKES_RGB (INTEGRATOR == INTEGRATOR_NORMALS || INTEGRATOR == INTEGRATOR_AO)

/// What LANES paths have to tell the film: radiance per camera wavelength, and what the first hit was.
typedef struct {
  uint count;         // of samples that wait
  uint pixel[LANES];  // of the window
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

/// The camera's wavelengths of LANES samples, found side by side.
typedef struct {
  float lambda[WAVELENGTHS][LANES];
  float inverse_pdf[WAVELENGTHS][LANES];  // in nm, over WAVELENGTHS
  int cell[WAVELENGTHS][LANES];           // of the spectrum, and where in it
  float within[WAVELENGTHS][LANES];
} FilmWavelengths;

STOKES_FN void film_wavelengths(const SceneView* view, const FilmSamples* s, FilmWavelengths* w) {
  Spectrum lambda, inverse_pdf;
  camera_wavelengths(view, load_real(s->u), &lambda, &inverse_pdf);
  FOR_EACH_WAVELENGTH(k) {
    Real within;
    store_int(spectrum_cell(lambda.v[k], &within), w->cell[k]);
    store_real(within, w->within[k]);
    store_real(lambda.v[k], w->lambda[k]);
    store_real(inverse_pdf.v[k] * real(1.0f / (float)WAVELENGTHS), w->inverse_pdf[k]);
  }
}

/// Sensor response at the fraction f of a cell of the spectrum: linear sRGB.
STOKES_FN float4 film_response(const SceneView* view, int c, float f) {
  const float4 a = vload4((size_t)(2 * c), view->sensor), b = vload4((size_t)(2 * c + 1), view->sensor);
  return fma((float4)(f), b - a, a);
}

/// Film radiance of sample j: x, y, z are R, G, B; w is the energy over all wavelengths.
STOKES_FN float4 film_radiance(const SceneView* view, const float radiance[WAVELENGTHS][LANES], const FilmWavelengths* w, uint j) {
  if (SCENE_RGB) return (float4)(radiance[0][j], radiance[1 % WAVELENGTHS][j], radiance[2 % WAVELENGTHS][j], 0.0f);
  float4 sum = (float4)(0.0f);
  FOR_EACH_WAVELENGTH(k) {
    float4 response = film_response(view, w->cell[k][j], w->within[k][j]);
    response.w = 1.0f;
    sum = fma((float4)(radiance[k][j] * w->inverse_pdf[k][j]), response, sum);
  }
  return sum;
}

/// Radiance per nm into the spectral bins that the camera's wavelengths fall in.
STOKES_FN void film_add_bins(const SceneView* view, __global long* words, const float radiance[WAVELENGTHS][LANES], const FilmWavelengths* w, uint j,
                             float per_quantum) {
  const float begin = view->scene->spectral_begin;
  const float per_nm = (float)view->scene->spectral_bins / (view->scene->spectral_end - begin);
  for (int k = 0; k < WAVELENGTHS; k++) {
    const float place = (w->lambda[k][j] - begin) * per_nm;
    if (!(place >= 0.0f && place < (float)view->scene->spectral_bins)) continue;
    film_add_word(words + (int)place, radiance[k][j] * w->inverse_pdf[k][j] * per_nm * per_quantum);
  }
}

/// The optional channels after the base words, in the order of layout.h; all of the sample's numbers have been accepted.
STOKES_FN void film_add_channels(const SceneView* view, __global long* words, const FilmSamples* s, const FilmWavelengths* w, uint j,
                                 float4 fluorescent, float per_quantum) {
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
  if (FILM_SPECTRAL) film_add_bins(view, words, s->radiance, w, j, per_quantum);
  if (FILM_KEEPS_FLUORESCENT_BINS) film_add_bins(view, words + view->scene->spectral_bins, s->fluorescence, w, j, per_quantum);
}

/// Adds waiting sample j to its pixel. A sample with a number that is not finite or too large is counted and left out.
STOKES_FN void film_add(const SceneView* view, __global long* words, const FilmSamples* s, const FilmWavelengths* w, uint j) {
  // The quantum is a power of two, so this scaling is exact.
  const float per_quantum = 1.0f / view->scene->film_quantum;
  const float4 rgb = FILM_TAKES_RGB ? (float4)(s->rgb[0][j], s->rgb[1][j], s->rgb[2][j], 0.0f) : film_radiance(view, s->radiance, w, j);
  const float4 scaled = rgb * per_quantum;
  float4 fluorescent = (float4)(0.0f);
  int valid = film_accepts(scaled.x) & film_accepts(scaled.y) & film_accepts(scaled.z);
  if (FILM_CHANNELS & FILM_FLUORESCENCE) {
    fluorescent = film_radiance(view, s->fluorescence, w, j);
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
  if (FILM_CHANNELS | FILM_SPECTRAL) film_add_channels(view, words + FILM_BASE_WORDS, s, w, j, fluorescent, per_quantum);
}

/// Adds all waiting samples to their pixels.
STOKES_APART void film_flush(const SceneView* view, __global long* film, FilmSamples* s) {
  if (LANES > 1 && s->count == 0u) return;
  FilmWavelengths w;
  film_wavelengths(view, s, &w);
  const uint count = LANES == 1 ? 1u : s->count;  // a constant spares GPUs arrays in memory
  for (uint j = 0u; j < count; j++) film_add(view, film + (ulong)s->pixel[j] * view->scene->film_stride, s, &w, j);
  s->count = 0u;
}

/// Nothing waits. Wavelengths are found for all lanes, of samples that were never written too.
STOKES_FN void film_samples_clear(FilmSamples* s) {
  s->count = 0u;
  for (int j = 0; j < LANES; j++) s->u[j] = 0.0f;
}

/// Lane j of `from` waits for the film, which has room for it.
STOKES_FN void film_keep(FilmSamples* s, const FilmSamples* from, uint j, uint pixel) {
  const uint i = LANES == 1 ? 0u : s->count;
  s->count++;
  s->pixel[i] = pixel;
  s->u[i] = from->u[j];
  s->alpha[i] = from->alpha[j];
  FOR_EACH_WAVELENGTH(k) s->radiance[k][i] = from->radiance[k][j];
  if (FILM_CHANNELS & FILM_FLUORESCENCE) FOR_EACH_WAVELENGTH(k) s->fluorescence[k][i] = from->fluorescence[k][j];
  if (FILM_CHANNELS & FILM_DEPTH) s->depth[i] = from->depth[j];
  for (int c = 0; c < 3; c++) {
    if (FILM_TAKES_RGB) s->rgb[c][i] = from->rgb[c][j];
    if (FILM_CHANNELS & FILM_ALBEDO) s->albedo[c][i] = from->albedo[c][j];
    if (FILM_CHANNELS & FILM_NORMAL) s->normal[c][i] = from->normal[c][j];
  }
}
#endif
