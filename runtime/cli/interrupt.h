// Ctrl-C and SIGTERM: before the first sample they end the process; then the first is a request to stop, a later one ends at once.
#pragma once
#include <atomic>

namespace stokes {

/// From now on SIGINT and SIGTERM end the process with kExitInterrupted: there is nothing to save yet.
void exit_on_interrupt();
/// From now on the first of them only sets a flag; one that is_another_stop() ends the process by the signal.
void catch_interrupts();
/// From now on signals are another process's affair: the two functions above do nothing, and `stop` is the request to stop.
void take_interrupts_from(const std::atomic<bool>& stop);
bool interrupted();
/// To be asked at each signal to stop: is it a second request? Not within half a second of the first, for timeout(1), supervisors and terminals
/// send one request both to a process and to its group. May be called in a signal's handler.
bool is_another_stop();

}  // namespace stokes
