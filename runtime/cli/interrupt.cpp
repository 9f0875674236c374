// Ctrl-C and SIGTERM: before the first sample they end the process; then the first is a request to stop, the second ends at once.
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "cli/exit_codes.h"

namespace stokes {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
const std::atomic<int>* others_stops = nullptr;

void install(void (*handler)(int)) {
  if (others_stops) return;
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | SA_NODEFER;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void end_at_once(int) {
  constexpr char kMessage[] = "interrupted before the first sample: nothing to save\n";
  if (write(STDERR_FILENO, kMessage, sizeof kMessage - 1) < 0) _exit(kExitInterrupted);
  _exit(kExitInterrupted);
}

void request_stop(int number) {
  if (stop_requested) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  stop_requested = 1;
}

}  // namespace

void exit_on_interrupt() { install(end_at_once); }

void catch_interrupts() { install(request_stop); }

void take_interrupts_from(const std::atomic<int>& stops) { others_stops = &stops; }

bool interrupted() { return stop_requested != 0 || (others_stops && *others_stops > 0); }

}  // namespace stokes
