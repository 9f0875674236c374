// One render from its first sample to its last: time limits, interruptions, checkpoints.
#include "cli/render_job.h"

#include <algorithm>
#include <chrono>

#include "cli/interrupt.h"
#include "cli/supervisor.h"

namespace stokes {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPublishSeconds = 1;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The record's counters and seconds from what they were and what the backend has counted since.
class Tally {
 public:
  Tally(const FilmRecord& record, const Backend& backend)
      : rays_(record.rays), shadow_rays_(record.shadow_rays), scatterings_(record.scatterings), paths_(record.paths),
        seconds_(record.render_seconds), before_(backend.counters()) {}
  void settle(FilmRecord& record, const Backend& backend) const {
    const RenderCounters now = backend.counters();
    record.rays = rays_ + now.rays - before_.rays;
    record.shadow_rays = shadow_rays_ + now.shadow_rays - before_.shadow_rays;
    record.scatterings = scatterings_ + now.scatterings - before_.scatterings;
    record.paths = paths_ + now.paths - before_.paths;
    record.render_seconds = seconds_ + since(start_);
  }
  double elapsed() const { return since(start_); }

 private:
  std::uint64_t rays_, shadow_rays_, scatterings_, paths_;
  double seconds_;
  RenderCounters before_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

RenderEnd run_job(RenderJob& job) {
  FilmRecord& record = job.record;
  const std::uint64_t pixels = static_cast<std::uint64_t>(record.film.width) * static_cast<std::uint64_t>(record.film.height);
  const int first = record.sample_end;
  const Tally tally(record, *job.backend);
  double saving = 0;  // seconds that the last checkpoint took
  Clock::time_point saved = Clock::now();
  while (record.sample_end < job.sample_end) {
    // A call ends at the job's end, or early: interrupted, or at the end of a pass, out of time or because somebody waits for the film.
    const int call_begin = record.sample_end;
    const Clock::time_point call_start = Clock::now();
    bool time_up = false, save_due = false;
    record.sample_end = job.backend->render(record.film, record.identity.seed, call_begin, job.sample_end, [&](const BackendProgress& p) {
      const std::uint64_t done = static_cast<std::uint64_t>(call_begin - first) * pixels + p.samples_done;
      tell_alive();
      if (job.progress) job.progress->update(done, p.counters.rays + p.counters.shadow_rays);
      if (interrupted()) return false;
      if (p.samples_done % pixels != 0) return true;
      // The next pass will take about as long as those before: the limit is a promise.
      const double next_pass = tally.elapsed() * static_cast<double>(pixels) / static_cast<double>(std::max<std::uint64_t>(1, done));
      time_up = job.max_seconds > 0 && tally.elapsed() + next_pass > job.max_seconds;
      const bool save = job.checkpoint_seconds > 0 && since(saved) >= std::max(job.checkpoint_seconds, saving / job.checkpoint_share);
      const bool show = job.publish && since(call_start) >= kPublishSeconds;
      save_due = save;
      return !time_up && !save && !show;
    });
    tally.settle(record, *job.backend);
    if (job.publish && record.sample_end > call_begin) job.publish(record);
    if (record.sample_end >= job.sample_end) break;
    if (interrupted()) return RenderEnd::Interrupted;
    if (time_up) return RenderEnd::TimeUp;
    if (!job.save_checkpoint || !save_due) continue;
    const Clock::time_point save_start = Clock::now();
    job.save_checkpoint(record);
    saved = Clock::now();
    saving = since(save_start);
  }
  tally.settle(record, *job.backend);
  return RenderEnd::Complete;
}

std::string describe_invalid(const FilmRecord& record, Backend& backend) {
  const FilmTotals totals = film_totals(record.film);
  if (totals.invalid == 0) return {};
  std::string text = std::to_string(totals.invalid) + " invalid samples (NaN, infinite or too large) were left out; the first at pixel (" +
                     std::to_string(totals.first_invalid_x) + ", " + std::to_string(totals.first_invalid_y) + ")";
  const Film& f = record.film;
  for (int sample = record.sample_begin; sample < record.sample_end && !interrupted(); sample++) {
    Film one = make_film(f.full_width, f.full_height, totals.first_invalid_x, totals.first_invalid_y, 1, 1, f.channels, f.spectral_bins,
                         f.spectral_begin, f.spectral_end, f.quantum, f.depth_quantum);
    backend.render(one, record.identity.seed, sample, sample + 1, [](const BackendProgress&) { return true; });
    tell_alive();
    if (film_totals(one).invalid > 0) return text + ", sample " + std::to_string(sample);
  }
  return text;
}

}  // namespace stokes
