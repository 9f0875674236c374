// Ctrl-C and SIGTERM: the first is a request to stop, the second ends the process at once.
#include "cli/interrupt.h"

#include <csignal>

namespace stokes {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void on_signal(int number) {
  if (stop_requested) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  stop_requested = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | SA_NODEFER;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return stop_requested != 0; }

}  // namespace stokes
