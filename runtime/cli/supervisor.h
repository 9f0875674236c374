// Work in a child process, so that a crash or a hang of an OpenCL driver is an error with a message and not the end of a night's render.
// Knows processes, signals and stages; nothing of rendering.
#pragma once
#include <functional>
#include <string>

namespace stokes {

/// What an attempt shall do otherwise than the first.
struct WorkerAttempt {
  bool resume = false;        ///< an earlier attempt has saved the checkpoint
  bool empty_caches = false;  ///< trust no cache, and let the driver use another disk
  bool optimise = true;       ///< false after crashes while building
};

struct SupervisorOptions {
  double launch_seconds = 60;  ///< a launch that takes so much longer than the longest before is given up
  std::string checkpoint;      ///< its name, for messages
  bool quiet = false;          ///< errors only
};

enum class WorkStage { Loading, Building, Rendering, Writing };

/// Calls `work` in a child process and returns there what it returns; to be called before other threads are made that `work` needs. In the
/// parent, returns the exit code once the child has ended. A child that crashes while building or rendering is followed by another, as
/// long as each saves a checkpoint; two that do not are the end (three while building, the last without optimisation). SIGINT and SIGTERM
/// end the child before its first sample; later, the first makes interrupted() true in the child and another (is_another_stop) ends both.
/// Killing the parent kills the child. Where no process can be made, `work` is called in this one.
int supervise(const SupervisorOptions& options, const std::function<int(const WorkerAttempt&)>& work);

/// What the child tells the supervisor; without one, nothing happens.
void enter_stage(WorkStage stage);
/// A launch has ended.
void tell_alive();
/// All is done, with this exit code; a child that ends without a word was ended by its driver (LLVM's fatal errors call exit).
void tell_exit_code(int code);
/// From now on, another attempt may resume.
void tell_checkpoint_saved();

}  // namespace stokes
