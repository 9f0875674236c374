// A render that is looked at while it grows: its thread, its film, and what a viewer may ask of both. Knows no network and no page.
#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "view/frame.h"
#include "view/orbit.h"
#include "view/view_scene.h"

namespace stokes {

enum class SessionPhase { Preparing, Preview, Rendering, Stopped, Done, Failed };

/// What a viewer is told; a copy, so that it is never half new.
struct SessionState {
  std::uint64_t version = 0;  ///< grows with every change of anything here
  std::uint32_t frame = 0;    ///< grows with every new picture
  SessionPhase phase = SessionPhase::Preparing;
  int samples = 0, samples_total = 0;  ///< per pixel; whole passes
  double progress = 0;                 ///< of all samples, with the unfinished pass
  double samples_per_second = 0;       ///< pixel samples; 0: not known yet
  double seconds_left = 0;
  double build_seconds = 0;
  int width = 0, height = 0;              ///< of the full picture
  int frame_width = 0, frame_height = 0;  ///< of the present one, which may be a coarse preview
  std::string device;
  std::vector<std::string> layers, warnings;
  bool spectral = false, fluorescent = false, moved = false, orthographic = false;
  std::string error;              ///< the scene or the device failed; the picture is the last good one
  CameraDescription camera;
};

/// A hand's movement of the camera; see Orbit.
struct CameraMove {
  double around = 0, up = 0, shift_right = 0, shift_up = 0, zoom = 1;
  bool reset = false;
};

class Session {
 public:
  /// Starts with `scene`, which may still have to be prepared; `load` is called, on the session's thread, after `reload`.
  /// `on_picture`, where given, is called there with every new picture.
  Session(std::unique_ptr<ViewScene> scene, ViewSceneLoader load, std::function<void(const Film&)> on_picture = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void move(const CameraMove& move);
  void stop();
  /// Goes on; a finished render gets as many samples again.
  void resume();
  /// The scene's files have changed.
  void reload();

  SessionState state() const;
  /// Returns when the state is not `version` any more, or after `timeout`, or when the session ends.
  SessionState wait(std::uint64_t version, std::chrono::milliseconds timeout) const;
  /// See encode_frame. Empty while there is no picture. Throws std::invalid_argument.
  std::string frame(const std::string& layer) const;
  /// The pixel of the present picture that covers (x, y) of the full one, or the mean over the pixels up to `radius` of the full one beside it;
  /// nullopt where there is none.
  std::optional<Probe> probe(double x, double y, double radius = 0) const;
  /// What has been rendered, for saving; nullopt while there is only a preview.
  std::optional<FilmRecord> record() const;
  /// Every file whose change asks for `reload`.
  std::vector<std::string> files() const;

 private:
  struct Wishes {
    bool camera = false, reload = false;
  };
  static Orbit orbit_about(const ViewScene& scene);
  void run();
  void load();
  void prepare();
  void start_view();
  void render_preview();
  void render_batch();
  bool interrupted() const;
  bool idle() const;      // the lock is held
  bool has_work() const;
  SessionState told() const;  // the lock is held
  int preview_divisor() const;
  void publish(FilmRecord&& record);
  void fail(const std::string& message);
  template <class Change>
  void change(Change&& change);

  ViewSceneLoader load_;
  std::unique_ptr<ViewScene> scene_;  // the thread's own after the constructor
  std::function<void(const Film&)> on_picture_;
  int divisor_ = 1;             // the thread's: of the next preview; 1: full pictures
  bool unseen_ = true;          // the thread's: the present view has had no picture yet
  double pass_seconds_ = 0;     // the thread's: of one full pass, as far as known
  double batch_seconds_ = 0;    // the thread's: how long the last batch should have taken
  double view_seconds_ = 0;     // the thread's: spent on full passes of this view
  std::uint64_t view_samples_ = 0;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  SessionState state_;
  FilmRecord record_;           // of the present picture
  bool preview_ = true;         // it is a preview
  std::optional<Orbit> orbit_;
  std::vector<std::string> files_;
  Wishes wishes_;
  bool stopped_ = false, quit_ = false;
  std::thread thread_;
};

/// The one place where what others see is changed.
template <class Change>
void Session::change(Change&& change) {
  {
    const std::lock_guard lock(mutex_);
    change();
    state_.version++;
  }
  changed_.notify_all();
}

}  // namespace stokes
