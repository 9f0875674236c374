// The paths that a work-item still has to start, and which pixel each lane works for. Knows pixels and samples, not light.
#ifndef STOKES_QUEUE_CL
#define STOKES_QUEUE_CL
#include "path.cl"

/// The samples [sample_begin, sample_end) of a run of pixels, pixel by pixel.
typedef struct {
  uint pixel, pixel_end;  // of the window, row by row
  uint x, y;              // of the next path's pixel, within the full image
  uint sample;
  // Per lane; pixel STOKES_NONE: idle.
  uint lane_pixel[LANES], lane_x[LANES], lane_y[LANES], lane_sample[LANES];
} PathQueue;

STOKES_FN PathQueue queue_make(const __global Launch* launch, uint item) {
  PathQueue q;
  const ulong begin = (ulong)launch->pixel_begin + (ulong)item * launch->chunk;
  const ulong end = begin + launch->chunk;
  q.pixel_end = end < launch->pixel_end ? (uint)end : launch->pixel_end;
  q.pixel = begin < q.pixel_end ? (uint)begin : q.pixel_end;
  if (launch->sample_begin >= launch->sample_end) q.pixel = q.pixel_end;
  const uint width = max(launch->crop_width, 1u);
  q.x = launch->crop_x + q.pixel % width;
  q.y = launch->crop_y + q.pixel / width;
  q.sample = launch->sample_begin;
  for (int j = 0; j < LANES; j++) {
    q.lane_pixel[j] = STOKES_NONE;
    q.lane_x[j] = q.lane_y[j] = q.lane_sample[j] = 0u;
  }
  return q;
}

/// Gives lane j the next path; 0 when there is none.
STOKES_FN int queue_next(PathQueue* q, const __global Launch* launch, uint j) {
  if (q->pixel == q->pixel_end) {
    q->lane_pixel[j] = STOKES_NONE;
    return 0;
  }
  q->lane_pixel[j] = q->pixel;
  q->lane_x[j] = q->x;
  q->lane_y[j] = q->y;
  q->lane_sample[j] = q->sample;
  q->sample++;
  if (q->sample == launch->sample_end) {
    q->sample = launch->sample_begin;
    q->pixel++;
    q->x++;
    if (q->x == launch->crop_x + launch->crop_width) {
      q->x = launch->crop_x;
      q->y++;
    }
  }
  return 1;
}

/// What the film has to be told about the paths.
STOKES_FN void film_samples(const PathState* path, FilmSamples* s) {
  store_real(path->camera_u, s->u);
  FOR_EACH_WAVELENGTH(k) store_real(path->radiance.v[k], s->radiance[k]);
  if (FILM_CHANNELS & FILM_FLUORESCENCE) FOR_EACH_WAVELENGTH(k) store_real(path->fluorescence.v[k], s->fluorescence[k]);
  if (FILM_TAKES_RGB) {
    store_real(path->rgb.x, s->rgb[0]);
    store_real(path->rgb.y, s->rgb[1]);
    store_real(path->rgb.z, s->rgb[2]);
  }
  store_real(path->alpha, s->alpha);
  if (FILM_CHANNELS & FILM_DEPTH) store_real(path->depth, s->depth);
  if (FILM_CHANNELS & FILM_ALBEDO) {
    store_real(path->albedo.x, s->albedo[0]);
    store_real(path->albedo.y, s->albedo[1]);
    store_real(path->albedo.z, s->albedo[2]);
  }
  if (FILM_CHANNELS & FILM_NORMAL) {
    store_real(path->normal.x, s->normal[0]);
    store_real(path->normal.y, s->normal[1]);
    store_real(path->normal.z, s->normal[2]);
  }
}

/// Hands the ended lanes' samples to the film and starts the next paths in them.
STOKES_FN void refill(const SceneView* view, const __global Launch* launch, PathQueue* q, PathState* path, __global long* film, Counters* counters) {
  FilmSamples samples;
  film_samples(path, &samples);
  uint fresh = 0u;
  for (uint ended = lane_bits(!path->alive); ended != 0u; ended &= ended - 1u) {
    const uint j = lowest_lane(ended);
    if (q->lane_pixel[j] != STOKES_NONE) film_add(view, film + (ulong)q->lane_pixel[j] * view->scene->film_stride, &samples, j);
    if (queue_next(q, launch, j)) fresh |= 1u << j;
  }
  if (fresh == 0u) return;
  counters->count[COUNTER_PATHS] += popcount(fresh);
  path_start(view, path, load_uint(q->lane_x), load_uint(q->lane_y), load_uint(q->lane_sample), launch->seed, lane_mask(fresh));
}
#endif
