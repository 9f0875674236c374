// One render from its first sample to its last: time limits, interruptions, checkpoints. Knows films and backends, not files'
// formats or options' spelling.
#pragma once
#include <functional>
#include <string>

#include "cli/backend.h"
#include "cli/progress.h"
#include "image/film_file.h"

namespace stokes {

struct RenderJob {
  Backend* backend = nullptr;
  FilmRecord record;  ///< holds the samples done so far; grows as the job runs
  int sample_end = 0;  ///< where to stop
  double max_seconds = 0;         ///< 0: no limit; at least one pass is rendered
  double checkpoint_seconds = 0;  ///< 0: none
  double checkpoint_share = 1;    ///< no more than this share of the time goes into saving
  std::function<void(const FilmRecord&)> save_checkpoint;
  std::function<void(const FilmRecord&)> publish;  ///< called about every second, and at the end
  ProgressReport* progress = nullptr;
};

enum class RenderEnd { Complete, TimeUp, Interrupted };

/// Renders until the job's end, the time limit or an interruption; the record then holds whole passes. Adds to the record's seconds
/// and counters.
RenderEnd run_job(RenderJob& job);

/// A film's invalid samples as a message with the first such pixel and sample (found by rendering that pixel again), or empty.
std::string describe_invalid(const FilmRecord& record, Backend& backend);

}  // namespace stokes
