// The paths that a work-item still has to start, and which pixel each lane works for. Knows pixels and samples, not light.
#ifndef STOKES_QUEUE_CL
#define STOKES_QUEUE_CL
#include "boundary.cl"

/// The samples [sample_begin, sample_end) of a run of pixels, pixel by pixel.
typedef struct {
  uint pixel, pixel_end;  // of the window, row by row
  uint x, y;              // of the next path's pixel, within the full image
  uint sample;
  // Paths are made LANES at a time, and wait here until a lane is free; `next` of `made` have gone.
  PathState waiting;
  uint waiting_pixel[LANES];
  uint next, made;
  uint lane_pixel[LANES];  // for which a lane works; STOKES_NONE: none
  Mask idle;               // lanes for which no path was left
  FilmSamples ended;       // samples that wait for the film
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
  q.next = q.made = 0u;
  q.idle = no_lanes();
  film_samples_clear(&q.ended);
  for (int j = 0; j < LANES; j++) q.lane_pixel[j] = STOKES_NONE;
  return q;
}

/// Makes the next paths; none are left when `made` is 0.
STOKES_APART void queue_make_paths(const SceneView* view, PathQueue* q, const __global Launch* launch, Counters* counters) {
  uint x[LANES], y[LANES], sample[LANES];
  uint made = 0u;
  for (int j = 0; j < LANES; j++) {
    q->waiting_pixel[j] = q->pixel;
    x[j] = q->x;
    y[j] = q->y;
    sample[j] = q->sample;
    if (q->pixel == q->pixel_end) continue;
    made++;
    q->sample++;
    if (q->sample < launch->sample_end) continue;
    q->sample = launch->sample_begin;
    q->pixel++;
    q->x++;
    if (q->x < launch->crop_x + launch->crop_width) continue;
    q->x = launch->crop_x;
    q->y++;
  }
  q->next = 0u;
  q->made = made;
  if (made == 0u) return;
  q->waiting = path_start(view, load_uint(x), load_uint(y), load_uint(sample), launch->seed);
  if (LANES > 1) path_approach(view, &q->waiting, lane_mask((1u << made) - 1u), counters);
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

/// Whether a lane's path has ended whose sample the film has not got yet.
STOKES_FN int has_ended_paths(const PathQueue* q, const PathState* path) { return any(!path->alive & !q->idle); }

/// Keeps the ended lanes' samples for the film and starts the next paths in them.
STOKES_FN void refill(const SceneView* view, const __global Launch* launch, PathQueue* q, PathState* path, __global long* film, Counters* counters) {
  FilmSamples samples;
  film_samples(path, &samples);
  uint fresh = 0u, idle = 0u;
  for (uint ended = lane_bits(!path->alive & !q->idle); ended != 0u; ended &= ended - 1u) {
    const uint j = lowest_lane(ended);
    if (q->lane_pixel[j] != STOKES_NONE) {
      film_keep(&q->ended, &samples, j, q->lane_pixel[j]);
      if (LANES == 1 || q->ended.count == LANES) film_flush(view, film, &q->ended);
    }
    q->lane_pixel[j] = STOKES_NONE;
    if (LANES == 1 || q->next == q->made) queue_make_paths(view, q, launch, counters);
    if (q->made == 0u) {
      idle |= 1u << j;
      continue;
    }
    q->lane_pixel[j] = q->waiting_pixel[q->next];
    path_take(path, &q->waiting, q->next, lane_mask(1u << j));
    q->next++;
    fresh |= 1u << j;
  }
  q->idle = q->idle | lane_mask(idle);
  if (LANES > 1 && lane_bits(!q->idle) == 0u) film_flush(view, film, &q->ended);
  if (fresh == 0u) return;
  counters->count[COUNTER_PATHS] += popcount(fresh);
  path_reset(path, lane_mask(fresh));
}
#endif
