// Ctrl-C and SIGTERM: before the first sample they end the process; then the first is a request to stop, a later one ends at once.
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>

#include "cli/exit_codes.h"

namespace stokes {
namespace {

constexpr std::int64_t kMoment = 500'000'000;  // ns; nobody presses a key twice in it on second thoughts

std::atomic<bool> stop_requested{false};  // any thread may run the handler
std::atomic<std::int64_t> first_stop{0};  // ns on the monotonic clock; 0: none yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);
const std::atomic<bool>* others_stop = nullptr;

void install(void (*handler)(int)) {
  if (others_stop) return;
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
  if (is_another_stop()) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  stop_requested = true;
}

}  // namespace

void exit_on_interrupt() { install(end_at_once); }

void catch_interrupts() { install(request_stop); }

void take_interrupts_from(const std::atomic<bool>& stop) { others_stop = &stop; }

bool is_another_stop() {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = time.tv_sec * 1'000'000'000LL + time.tv_nsec;
  std::int64_t first = 0;
  return !first_stop.compare_exchange_strong(first, now) && now - first >= kMoment;
}

bool interrupted() { return stop_requested || (others_stop && *others_stop); }

}  // namespace stokes
