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
  uint count;          // of samples that wait
  uint pixel[LANES];   // of the window
  float u[LANES];  // the number the camera's wavelengths came from
  float radiance[WAVELENGTHS][LANES];
  float fluorescence[WAVELENGTHS][LANES];  // the part that went through a fluorescent event
  float rgb[3][LANES];
  float alpha[LANES], depth[LANES];
  float albedo[3][LANES], normal[3][LANES];
} FilmSamples;

/// How many samples are to be added; with one lane a constant, which spares GPUs arrays in memory.
STOKES_FN uint film_waiting(const FilmSamples* s) { return LANES == 1 ? 1u : s->count; }

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

/// Sensor response at the fraction f of a cell of the spectrum: linear sRGB.
STOKES_FN float4 film_response(const SceneView* view, int c, float f) {
  const float4 a = vload4((size_t)(2 * c), view->sensor), b = vload4((size_t)(2 * c + 1), view->sensor);
  return fma((float4)(f), b - a, a);
}

/// Film radiance of all waiting samples: x, y, z are R, G, B; w is the energy over all wavelengths.
STOKES_FN void film_radiances(const SceneView* view, const FilmSamples* s, const float radiance[WAVELENGTHS][LANES], float4* out) {
  if (SCENE_RGB) {
    for (uint j = 0u; j < film_waiting(s); j++) out[j] = (float4)(radiance[0][j], radiance[1 % WAVELENGTHS][j], radiance[2 % WAVELENGTHS][j], 0.0f);
    return;
  }
  // Wavelengths, their cells in the sensor's table and their weights side by side, the table's rows one after the other.
  Spectrum lambda, inverse_pdf;
  camera_wavelengths(view, load_real(s->u), &lambda, &inverse_pdf);
  int cell[WAVELENGTHS][LANES];
  float within[WAVELENGTHS][LANES], weight[WAVELENGTHS][LANES];
  FOR_EACH_WAVELENGTH(k) {
    Real f;
    store_int(spectrum_cell(lambda.v[k], &f), cell[k]);
    store_real(f, within[k]);
    store_real(load_real(radiance[k]) * (inverse_pdf.v[k] * real(1.0f / (float)WAVELENGTHS)), weight[k]);
  }
  for (uint j = 0u; j < film_waiting(s); j++) {
    float4 sum = (float4)(0.0f);
    FOR_EACH_WAVELENGTH(k) {
      float4 response = film_response(view, cell[k][j], within[k][j]);
      response.w = 1.0f;
      sum = fma((float4)(weight[k][j]), response, sum);
    }
    out[j] = sum;
  }
}

/// Radiance per nm into the spectral bins that the camera's wavelengths fall in.
STOKES_FN void film_add_bins(const SceneView* view, __global long* words, float u, const float radiance[WAVELENGTHS][LANES], uint j, float per_quantum) {
  const float begin = view->scene->spectral_begin;
  const float per_nm = (float)view->scene->spectral_bins / (view->scene->spectral_end - begin);
  for (int k = 0; k < WAVELENGTHS; k++) {
    float inverse_pdf;
    const float place = (film_wavelength(view, u, k, &inverse_pdf) - begin) * per_nm;
    if (!(place >= 0.0f && place < (float)view->scene->spectral_bins)) continue;
    film_add_word(words + (int)place, radiance[k][j] * (inverse_pdf * (1.0f / (float)WAVELENGTHS)) * per_nm * per_quantum);
  }
}

/// The optional channels after the base words, in the order of layout.h; all of the sample's numbers have been accepted.
STOKES_FN void film_add_channels(const SceneView* view, __global long* words, const FilmSamples* s, uint j, float4 fluorescent,
                                 float per_quantum) {
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
  if (FILM_SPECTRAL) film_add_bins(view, words, s->u[j], s->radiance, j, per_quantum);
  if (FILM_KEEPS_FLUORESCENT_BINS) film_add_bins(view, words + view->scene->spectral_bins, s->u[j], s->fluorescence, j, per_quantum);
}

/// Adds waiting sample j to its pixel. A sample with a number that is not finite or too large is counted and left out.
STOKES_FN void film_add(const SceneView* view, __global long* words, const FilmSamples* s, uint j, float4 rgb, float4 fluorescent) {
  // The quantum is a power of two, so this scaling is exact.
  const float per_quantum = 1.0f / view->scene->film_quantum;
  const float4 scaled = rgb * per_quantum;
  int valid = film_accepts(scaled.x) & film_accepts(scaled.y) & film_accepts(scaled.z);
  if (FILM_CHANNELS & FILM_FLUORESCENCE)
    valid &= film_accepts(fluorescent.x * per_quantum) & film_accepts(fluorescent.y * per_quantum) &
             film_accepts(fluorescent.z * per_quantum) & film_accepts(fluorescent.w * per_quantum);
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
  if (FILM_CHANNELS | FILM_SPECTRAL) film_add_channels(view, words + FILM_BASE_WORDS, s, j, fluorescent, per_quantum);
}

/// Adds all waiting samples to their pixels.
STOKES_APART void film_flush(const SceneView* view, __global long* film, FilmSamples* s) {
  if (LANES > 1 && s->count == 0u) return;
  float4 rgb[LANES], fluorescent[LANES];
  for (uint j = 0u; j < film_waiting(s); j++) fluorescent[j] = (float4)(0.0f);
  if (FILM_TAKES_RGB)
    for (uint j = 0u; j < film_waiting(s); j++) rgb[j] = (float4)(s->rgb[0][j], s->rgb[1][j], s->rgb[2][j], 0.0f);
  else
    film_radiances(view, s, s->radiance, rgb);
  if (FILM_CHANNELS & FILM_FLUORESCENCE) film_radiances(view, s, s->fluorescence, fluorescent);
  for (uint j = 0u; j < film_waiting(s); j++) film_add(view, film + (ulong)s->pixel[j] * view->scene->film_stride, s, j, rgb[j], fluorescent[j]);
  s->count = 0u;
}

/// Nothing waits. Numbers that are looked up without having been written are in their ranges.
STOKES_FN void film_samples_clear(FilmSamples* s) {
  s->count = 0u;
  for (int j = 0; j < LANES; j++) {
    s->u[j] = 0.0f;
    FOR_EACH_WAVELENGTH(k) s->radiance[k][j] = s->fluorescence[k][j] = 0.0f;
  }
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
