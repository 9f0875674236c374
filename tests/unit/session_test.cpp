// What a viewer is told of a render that it moves, stops and edits. The scene is a stand-in whose passes wait for the test, so that every state is seen for certain.
#include "view/session.h"

#include <gtest/gtest.h>

#include <condition_variable>

namespace stokes {
namespace {

/// A gate that the session's thread waits at while it is closed, and that tells when somebody waits.
class Gate {
 public:
  void close() { set(false); }
  void open() { set(true); }
  void pass() {
    std::unique_lock lock(mutex_);
    waiting_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return open_; });
    waiting_ = false;
  }
  /// Returns when a thread waits at the closed gate; false after a minute.
  bool reached() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::minutes(1), [&] { return waiting_ && !open_; });
  }

 private:
  void set(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true, waiting_ = false;
};

/// An empty scene of 4 x 3 pixels and 12 samples whose passes cost nothing.
class StandIn : public ViewScene {
 public:
  explicit StandIn(Gate& gate) : gate_(gate) {
    compiled_.samples = 12;
    camera_.width = 4;
    camera_.height_pixels = 3;
    camera_.transform.m[0] = camera_.transform.m[5] = camera_.transform.m[10] = 1;
  }
  const CompiledScene& compiled() const override { return compiled_; }
  const CameraDescription& camera() const override { return camera_; }
  std::string hash() const override { return "hash"; }
  std::string device() const override { return "stand-in"; }
  std::vector<std::string> files() const override { return {}; }
  std::vector<std::string> warnings() const override { return {}; }
  double prepare() override { return 0; }
  void look(const CameraDescription&) override { gate_.pass(); }
  FilmRecord empty_record() const override {
    FilmRecord record;
    record.film.width = 4;
    record.film.height = 3;
    record.film.stride = 1;
    record.film.words.resize(12);
    return record;
  }
  int render(Film&, int, int end, const std::function<bool(std::uint64_t)>&) override { return end; }

 private:
  Gate& gate_;
  CompiledScene compiled_;
  CameraDescription camera_;
};

class SessionTest : public testing::Test {
 protected:
  /// The state when the render is done; the last one after a minute.
  SessionState done() {
    SessionState state = session_.state();
    for (int i = 0; i < 60 && state.phase != SessionPhase::Done; i++) state = session_.wait(state.version, std::chrono::seconds(1));
    return state;
  }
  Gate gate_;
  Session session_{std::make_unique<StandIn>(gate_), [this] { return std::make_unique<StandIn>(gate_); }};
};

TEST_F(SessionTest, AMovedCameraIsNotDoneBeforeItsPicture) {
  const SessionState before = done();
  ASSERT_EQ(before.samples, 12);
  gate_.close();
  CameraMove move;
  move.around = 0.5;
  session_.move(move);
  ASSERT_TRUE(gate_.reached());
  const SessionState moved = session_.state();
  EXPECT_TRUE(moved.moved);
  EXPECT_EQ(moved.frame, before.frame);
  EXPECT_NE(moved.phase, SessionPhase::Done) << "what is shown is the picture of before the move";
  gate_.open();
  const SessionState after = done();
  EXPECT_EQ(after.samples, 12);
  EXPECT_GT(after.frame, before.frame);
}

TEST_F(SessionTest, OnlyAFinishedRenderGetsAsManySamplesAgain) {
  ASSERT_EQ(done().samples, 12);
  session_.resume();
  for (SessionState state = session_.state(); state.samples != 24; state = session_.wait(state.version, std::chrono::seconds(60)))
    ASSERT_LT(state.samples, 24);
  ASSERT_EQ(done().samples_total, 24);
  // A camera on its way: there is nothing finished of the new view.
  gate_.close();
  CameraMove move;
  move.zoom = 2;
  session_.move(move);
  session_.resume();
  gate_.open();
  ASSERT_EQ(session_.state().samples_total, 24);
}

}  // namespace
}  // namespace stokes
