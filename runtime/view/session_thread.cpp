// The thread of a session: reads what has changed, renders previews and batches without holding the lock, publishes pictures.
#include <algorithm>
#include <cmath>
#include <utility>

#include "compiled/first_hit.h"
#include "compiled/look_from.h"
#include "layout.h"
#include "view/session.h"

namespace stokes {
namespace {

using Clock = std::chrono::steady_clock;

// A moved camera shows a first picture after about this long; batches of full passes grow from the second to the third.
constexpr double kPreviewSeconds = 0.08, kFirstBatchSeconds = 0.25, kLastBatchSeconds = 2;
constexpr int kCoarsest = 16;
// States of a running pass are told this often.
constexpr double kTellSeconds = 0.25;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The distance to what the camera's axis meets, or to the level of the scene's centre.
double reach_of(const ViewScene& scene) {
  const CameraDescription& camera = scene.camera();
  const Vec3d position = camera.transform.translation(), forwards = normalize(-camera.transform.column(2));
  if (const auto hit = compiled::first_hit(scene.compiled(), position, forwards)) return hit->t;
  const layout::Scene& h = scene.compiled().header;
  const Vec3d center{h.scene_center.x, h.scene_center.y, h.scene_center.z};
  const double level = dot(center - position, forwards);
  return level > 0 ? level : std::max(1e-3, double(h.scene_radius));
}

bool same_camera(const CameraDescription& a, const CameraDescription& b) {
  return a.transform.m == b.transform.m && a.orthographic == b.orthographic && a.vfov == b.vfov && a.height == b.height && a.fdist == b.fdist &&
         a.aperture == b.aperture && a.width == b.width && a.height_pixels == b.height_pixels;
}

}  // namespace

Orbit Session::orbit_about(const ViewScene& scene) { return {scene.camera(), reach_of(scene)}; }

bool Session::interrupted() const {
  const std::lock_guard lock(mutex_);
  // While a hand drags, wishes come faster than pictures: the first picture of each view is finished, or there would be none.
  return quit_ || stopped_ || (wishes_.camera && !unseen_) || wishes_.reload;
}

void Session::fail(const std::string& message) {
  change([&] {
    state_.error = message;
    if (!scene_) state_.phase = SessionPhase::Failed;
  });
}

void Session::run() {
  bool fresh = true;
  while (true) {
    Wishes wishes;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return quit_ || fresh || wishes_.camera || wishes_.reload || !idle(); });
      if (quit_) return;
      wishes = std::exchange(wishes_, {});
    }
    const bool begin = std::exchange(fresh, false);
    try {
      if (begin) prepare();
      if (wishes.reload) load();
      if (scene_ && (wishes.camera || begin)) start_view();
      if (!interrupted() && has_work()) {
        if (divisor_ > 1)
          render_preview();
        else
          render_batch();
      }
    } catch (const std::exception& error) {
      // The device failed: nothing more can be done with this scene. The last picture stays.
      scene_.reset();
      fail(error.what());
    }
  }
}

bool Session::idle() const { return !scene_ || stopped_ || (divisor_ == 1 && !preview_ && record_.sample_end >= state_.samples_total); }

bool Session::has_work() const {
  const std::lock_guard lock(mutex_);
  return !idle();
}

/// Reads the changed files. A scene with an error changes nothing but the message.
void Session::load() {
  std::unique_ptr<ViewScene> loaded;
  try {
    loaded = load_();
  } catch (const std::exception& error) {
    fail(error.what());
    return;
  }
  const bool same = scene_ && loaded->hash() == scene_->hash();
  change([&] {
    files_ = loaded->files();
    state_.error.clear();
    if (same) state_.samples_total = loaded->compiled().samples;
    if (same && !preview_ && record_.sample_end >= state_.samples_total) state_.phase = SessionPhase::Done;
    if (!same) state_.phase = SessionPhase::Preparing;
    if (!same && !same_camera(loaded->camera(), orbit_->first_camera())) orbit_ = orbit_about(*loaded);
  });
  if (same) return;
  scene_ = std::move(loaded);
  prepare();
  start_view();
}

void Session::prepare() {
  change([&] {
    const layout::Scene& h = scene_->compiled().header;
    state_.phase = SessionPhase::Preparing;
    state_.samples_total = scene_->compiled().samples;
    state_.device = scene_->device();
    state_.warnings = scene_->warnings();
    state_.layers = frame_layers(h.film_channels);
    state_.spectral = h.spectral_bins > 0;
    state_.fluorescent = h.film_channels & FILM_FLUORESCENT_BINS;
  });
  const double seconds = scene_->prepare();
  pass_seconds_ = 0;
  change([&] { state_.build_seconds = seconds; });
}

/// Begins again from the present camera, with a coarse picture first.
void Session::start_view() {
  divisor_ = preview_divisor();
  unseen_ = true;
  batch_seconds_ = kFirstBatchSeconds;
  view_seconds_ = 0;
  view_samples_ = 0;
  change([&] {
    // What is shown is of another view from here on: whoever waits for "done" must not be told so because the last one was.
    state_.phase = SessionPhase::Preview;
    state_.camera = orbit_->camera();
    state_.moved = orbit_->moved();
    state_.orthographic = state_.camera.orthographic;
    state_.width = state_.camera.width;
    state_.height = state_.camera.height_pixels;
    state_.samples = 0;
    state_.progress = 0;
    preview_ = true;
  });
}

/// How much smaller than the full picture the first one is, so that it takes about kPreviewSeconds.
int Session::preview_divisor() const {
  const CameraDescription& camera = orbit_->first_camera();
  const double pixels = static_cast<double>(camera.width) * camera.height_pixels;
  // Before any speed is known, a picture of some ten thousand pixels.
  const double affordable = pass_seconds_ > 0 ? pixels * kPreviewSeconds / pass_seconds_ : 16384;
  int divisor = 1;
  while (divisor < kCoarsest && pixels / (divisor * divisor) > affordable && camera.width >= 16 * divisor && camera.height_pixels >= 16 * divisor)
    divisor *= 2;
  return divisor;
}

void Session::render_preview() {
  CameraDescription camera;
  change([&] {
    camera = state_.camera;
    state_.phase = SessionPhase::Preview;
  });
  camera.width = std::max(1, camera.width / divisor_);
  camera.height_pixels = std::max(1, camera.height_pixels / divisor_);
  scene_->look(camera);
  FilmRecord record = scene_->empty_record();
  const Clock::time_point start = Clock::now();
  record.sample_begin = 0;
  record.sample_end = scene_->render(record.film, 0, 1, [&](std::uint64_t) { return !interrupted(); });
  if (record.sample_end < 1) return;
  if (pass_seconds_ == 0) pass_seconds_ = since(start) * divisor_ * divisor_;
  publish(std::move(record));
  divisor_ = divisor_ > 4 ? divisor_ / 4 : 1;
}

void Session::render_batch() {
  CameraDescription camera;
  FilmRecord record;
  int total = 0;
  {
    const std::lock_guard lock(mutex_);
    camera = state_.camera;
    total = state_.samples_total;
    if (!preview_) record = record_;
  }
  const bool first = record.film.words.empty();
  if (first) {
    scene_->look(camera);
    record = scene_->empty_record();
  }
  change([&] { state_.phase = SessionPhase::Rendering; });
  const int begin = record.sample_end;
  const int count = first || pass_seconds_ <= 0 ? 1 : std::max(1, static_cast<int>(batch_seconds_ / pass_seconds_));
  const std::uint64_t pixels = static_cast<std::uint64_t>(record.film.width) * static_cast<std::uint64_t>(record.film.height);
  const Clock::time_point start = Clock::now();
  Clock::time_point told = start;
  record.sample_end = scene_->render(record.film, begin, std::min(total, begin + count), [&](std::uint64_t done) {
    if (since(told) > kTellSeconds) {
      told = Clock::now();
      change([&] { state_.progress = (begin + static_cast<double>(done) / static_cast<double>(pixels)) / std::max(1, total); });
    }
    return !interrupted();
  });
  const int passes = record.sample_end - begin;
  if (passes == 0) return;
  const double seconds = since(start);
  pass_seconds_ = seconds / passes;
  batch_seconds_ = std::min(kLastBatchSeconds, batch_seconds_ * 2);
  view_seconds_ += seconds;
  view_samples_ += pixels * static_cast<std::uint64_t>(passes);
  record.render_seconds += seconds;
  publish(std::move(record));
}

void Session::publish(FilmRecord&& record) {
  unseen_ = false;
  bool dropped = false;
  change([&] {
    // A picture of a camera that has moved on is still worth showing, but not worth adding to.
    dropped = wishes_.reload;
    if (dropped) return;
    record_ = std::move(record);
    record_.samples_total = std::max(state_.samples_total, record_.sample_end);
    preview_ = divisor_ > 1;
    state_.frame++;
    state_.frame_width = record_.film.width;
    state_.frame_height = record_.film.height;
    if (!preview_) {
      state_.samples = record_.sample_end;
      state_.progress = static_cast<double>(record_.sample_end) / std::max(1, state_.samples_total);
      state_.samples_per_second = view_seconds_ > 0 ? static_cast<double>(view_samples_) / view_seconds_ : 0;
      state_.seconds_left = pass_seconds_ * std::max(0, state_.samples_total - record_.sample_end);
      if (record_.sample_end >= state_.samples_total) state_.phase = SessionPhase::Done;
    }
  });
  // Only this thread writes the record, so that it may be read here without the lock.
  if (on_picture_ && !dropped) on_picture_(record_.film);
}

}  // namespace stokes
