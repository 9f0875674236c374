// The parent's waiting and judging. It and the child share a page of memory, because the child may be past sending messages.
#include "cli/supervisor.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>

#include "cli/exit_codes.h"
#include "cli/interrupt.h"

namespace stokes {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBuildSeconds = 1800;  // some compilers need minutes; none needs half an hour
constexpr double kExitSeconds = 10;     // for a driver's own work at exit
constexpr int kStillRunning = -1;

/// What parent and child both see.
struct Board {
  std::atomic<bool> stop{false};  ///< by the parent: save and end
  std::atomic<WorkStage> stage{WorkStage::Loading};
  std::atomic<unsigned> beats{0};
  std::atomic<bool> checkpoint{false};  ///< saved, in any attempt
  std::atomic<unsigned> saves{0};
  std::atomic<int> exit_code{kStillRunning};
};
static_assert(std::atomic<WorkStage>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

Board* board = nullptr;  // null where nobody supervises

Board* shared_board() {
  void* memory = ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : new (memory) Board;
}

bool is_crash(int signal) {
  for (const int crash : {SIGSEGV, SIGBUS, SIGILL, SIGABRT, SIGFPE, SIGTRAP, SIGSYS})
    if (signal == crash) return true;
  return false;
}

const char* stage_text(WorkStage stage) {
  switch (stage) {
    case WorkStage::Loading: return "loading the scene";
    case WorkStage::Building: return "building kernels";
    case WorkStage::Rendering: return "rendering";
    case WorkStage::Writing: return "writing";
  }
  return "";
}

/// Stopped by a debugger or a signal: silence is no sign of a hang then.
bool is_stopped(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(") ");
  return name_end != std::string::npos && (text[name_end + 2] == 'T' || text[name_end + 2] == 't');
}

/// Notices when a child that should tell of launches does so no more.
class Watchdog {
 public:
  explicit Watchdog(double launch_seconds) : launch_seconds_(launch_seconds) {}
  /// To be called at least every second.
  bool is_hung(pid_t child) {
    const Clock::time_point now = Clock::now();
    // A tick counts for 2 s at most: when this process was stopped, so was the child.
    silent_ += std::min(2.0, std::chrono::duration<double>(now - tick_).count());
    tick_ = now;
    const unsigned beats = board->beats;
    const WorkStage stage = board->stage;
    const bool ending = board->exit_code != kStillRunning;
    if (beats != beats_ || stage != stage_ || ending != ending_) {
      if (stage == WorkStage::Rendering && stage_ == stage) longest_ = std::max(longest_, silent_);
      silent_ = 0;
    }
    beats_ = beats, stage_ = stage, ending_ = ending;
    if (silent_ <= limit()) return false;
    if (!is_stopped(child)) return true;
    silent_ = 0;
    return false;
  }
  double limit() const {
    if (ending_) return kExitSeconds;
    if (stage_ == WorkStage::Building) return kBuildSeconds;
    return stage_ == WorkStage::Rendering ? launch_seconds_ + longest_ : HUGE_VAL;
  }

 private:
  double launch_seconds_, silent_ = 0, longest_ = 0;
  unsigned beats_ = 0;
  WorkStage stage_ = WorkStage::Loading;
  bool ending_ = false;
  Clock::time_point tick_ = Clock::now();
};

/// How a child ended.
struct Ending {
  enum { Exited, Signalled, Hung, Stopped } how = Exited;
  int value = 0;  ///< the exit code; the signal; the limit in seconds; the signal that stopped it
};

class Supervisor {
 public:
  explicit Supervisor(const SupervisorOptions& options) : options_(options) {
    sigemptyset(&signals_);
    for (const int number : {SIGCHLD, SIGINT, SIGTERM}) sigaddset(&signals_, number);
  }
  /// From now on signals wait until the supervisor looks.
  void hold_signals() {
    std::signal(SIGCHLD, SIG_DFL);
    sigprocmask(SIG_BLOCK, &signals_, &before_);
  }
  /// In the child: those to stop are the parent's affair.
  void release_signals() const {
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_IGN);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  Ending watch(pid_t child);
  /// The exit code, or nothing where `next` is to be tried.
  std::optional<int> judge(const Ending& ending, WorkerAttempt& next);

 private:
  void kill_child(pid_t child);
  std::optional<int> judge_crash(const std::string& event, WorkerAttempt& next);
  int fail(int code, const std::string& message) const;
  std::string checkpoint_hint() const;

  SupervisorOptions options_;
  sigset_t signals_ = {}, before_ = {};
  unsigned saves_before_ = 0;
  int crashes_in_vain_ = 0;
};

/// Ends a child for certain, unless a driver holds it in the kernel: then it is left behind.
void Supervisor::kill_child(pid_t child) {
  ::kill(child, SIGKILL);
  for (int tenths = 0; tenths < 50 && ::waitpid(child, nullptr, WNOHANG) == 0; tenths++) ::usleep(100000);
}

Ending Supervisor::watch(pid_t child) {
  Watchdog watchdog(options_.launch_seconds);
  while (true) {
    const timespec second = {1, 0};
    const int signal = sigtimedwait(&signals_, nullptr, &second);
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child)
      return WIFSIGNALED(status) ? Ending{Ending::Signalled, WTERMSIG(status)} : Ending{Ending::Exited, WEXITSTATUS(status)};
    if (signal == SIGINT || signal == SIGTERM) {
      const WorkStage stage = board->stage;
      const bool early = stage == WorkStage::Loading || stage == WorkStage::Building;
      if (is_another_stop() || early) {
        kill_child(child);
        return {Ending::Stopped, early ? 0 : signal};
      }
      board->stop = true;
    }
    if (watchdog.is_hung(child)) {
      const double limit = watchdog.limit();
      kill_child(child);
      return {Ending::Hung, static_cast<int>(limit)};
    }
  }
}

int Supervisor::fail(int code, const std::string& message) const {
  std::fprintf(stderr, "%serror: %s\n", ::isatty(STDERR_FILENO) ? "\r\x1b[K" : "", message.c_str());
  return code;
}

std::string Supervisor::checkpoint_hint() const {
  return board->checkpoint ? "; " + options_.checkpoint + " holds what was done by then, --resume continues it" : "";
}

std::optional<int> Supervisor::judge(const Ending& ending, WorkerAttempt& next) {
  // What a driver does after the work is done is no matter.
  if (ending.how != Ending::Stopped && board->exit_code != kStillRunning) return board->exit_code;
  const std::string during = stage_text(board->stage);
  switch (ending.how) {
    case Ending::Exited: return judge_crash("an exit of the driver's own (code " + std::to_string(ending.value) + ")", next);
    case Ending::Hung:
      return fail(kExitDevice, "the device gave no sign of life for " + std::to_string(ending.value) + " s while " + during + checkpoint_hint());
    case Ending::Stopped:
      if (ending.value == 0) {
        std::fprintf(stderr, "interrupted before the first sample: nothing to save\n");
        return kExitInterrupted;
      }
      std::signal(ending.value, SIG_DFL);
      sigprocmask(SIG_SETMASK, &before_, nullptr);
      std::raise(ending.value);
      return kExitInterrupted;
    case Ending::Signalled: break;
  }
  if (ending.value == SIGKILL)
    return fail(kExitMemory, "the renderer was killed while " + during + ", as systems do when memory runs out" + checkpoint_hint());
  if (!is_crash(ending.value)) return fail(kExitInternal, "ended by signal " + std::to_string(ending.value) + " while " + during + checkpoint_hint());
  return judge_crash("a crash (signal " + std::to_string(ending.value) + ")", next);
}

std::optional<int> Supervisor::judge_crash(const std::string& event, WorkerAttempt& next) {
  const WorkStage stage = board->stage;
  const std::string what = event + " while " + stage_text(stage);
  const bool on_device = stage == WorkStage::Building || stage == WorkStage::Rendering;
  if (!on_device) return fail(kExitInternal, "internal error: " + what + checkpoint_hint());
  const bool progress = board->saves != saves_before_;
  saves_before_ = board->saves;
  crashes_in_vain_ = progress ? 1 : crashes_in_vain_ + 1;
  if (crashes_in_vain_ > (stage == WorkStage::Building ? 2 : 1)) return fail(kExitDevice, what + ", again: the OpenCL driver may be broken" + checkpoint_hint());
  next.empty_caches = true;
  next.resume = board->checkpoint;
  next.optimise = crashes_in_vain_ < 2;
  if (!options_.quiet)
    std::fprintf(stderr, "%swarning: %s; trying again with empty caches%s%s\n", ::isatty(STDERR_FILENO) ? "\r\x1b[K" : "", what.c_str(),
                 next.optimise ? "" : " and without optimisation", next.resume ? (" from " + options_.checkpoint).c_str() : "");
  return std::nullopt;
}

}  // namespace

int supervise(const SupervisorOptions& options, const std::function<int(const WorkerAttempt&)>& work) {
  Board* const shared = shared_board();
  if (!shared) return work({});
  Supervisor supervisor(options);
  supervisor.hold_signals();
  WorkerAttempt attempt;
  while (true) {
    shared->stage = WorkStage::Loading;
    const pid_t parent = ::getpid(), child = ::fork();
    if (child <= 0) supervisor.release_signals();
    if (child < 0) {
      exit_on_interrupt();
      return work(attempt);
    }
    board = shared;
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) std::_Exit(kExitInternal);
      take_interrupts_from(shared->stop);
      // Threads do not outlive fork(): the destructors of libraries loaded before it would wait for theirs for ever, so they are left out.
      ::on_exit([](int status, void*) { std::cout.flush(), std::fflush(nullptr), std::_Exit(status); }, nullptr);
      return work(attempt);
    }
    if (const std::optional<int> code = supervisor.judge(supervisor.watch(child), attempt)) return *code;
  }
}

void enter_stage(WorkStage stage) {
  if (board) board->stage = stage;
}

void tell_alive() {
  if (board) board->beats++;
}

void tell_exit_code(int code) {
  if (board) board->exit_code = code;
}

void tell_checkpoint_saved() {
  if (!board) return;
  board->checkpoint = true;
  board->saves++;
}

}  // namespace stokes
