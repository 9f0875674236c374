// What viewers may ask of a session: see session.h. The thread behind it is in session_thread.cpp.
#include "view/session.h"

#include <algorithm>
#include <utility>

namespace stokes {

Session::Session(std::unique_ptr<ViewScene> scene, ViewSceneLoader load, std::function<void(const Film&)> on_picture)
    : load_(std::move(load)), scene_(std::move(scene)), on_picture_(std::move(on_picture)) {
  state_.device = scene_->device();
  orbit_ = orbit_about(*scene_);
  files_ = scene_->files();
  thread_ = std::thread([this] { run(); });
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Session::move(const CameraMove& move) {
  change([&] {
    if (move.reset) orbit_->reset();
    if (move.around != 0 || move.up != 0) orbit_->turn(move.around, move.up);
    if (move.shift_right != 0 || move.shift_up != 0) orbit_->shift(move.shift_right, move.shift_up);
    if (move.zoom != 1) orbit_->zoom(move.zoom);
    wishes_.camera = true;
    stopped_ = false;
  });
}

void Session::stop() {
  change([&] { stopped_ = true; });
}

void Session::resume() {
  change([&] {
    if (state_.phase == SessionPhase::Done && !wishes_.camera && !wishes_.reload) state_.samples_total *= 2;
    stopped_ = false;
  });
}

void Session::reload() {
  change([&] { wishes_.reload = true; });
}

SessionState Session::told() const {
  SessionState state = state_;
  const bool running = state.phase == SessionPhase::Preview || state.phase == SessionPhase::Rendering;
  if (stopped_ && running) state.phase = SessionPhase::Stopped;
  return state;
}

SessionState Session::state() const {
  const std::lock_guard lock(mutex_);
  return told();
}

SessionState Session::wait(std::uint64_t version, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return quit_ || state_.version != version; });
  return told();
}

std::string Session::frame(const std::string& layer) const {
  const std::lock_guard lock(mutex_);
  if (state_.frame == 0) return {};
  return encode_frame(record_.film, layer, record_.sample_end, state_.frame);
}

std::optional<Probe> Session::probe(double x, double y, double radius) const {
  const std::lock_guard lock(mutex_);
  if (state_.frame == 0 || !(x >= 0 && y >= 0 && x < state_.width && y < state_.height)) return std::nullopt;
  const Film& film = record_.film;
  return probe_film(film, static_cast<int>(x * film.width / state_.width), static_cast<int>(y * film.height / state_.height),
                    static_cast<int>(std::clamp(radius, 0.0, 32.0) * film.width / state_.width));
}

std::optional<FilmRecord> Session::record() const {
  const std::lock_guard lock(mutex_);
  if (state_.frame == 0 || preview_) return std::nullopt;
  return record_;
}

std::vector<std::string> Session::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

}  // namespace stokes
