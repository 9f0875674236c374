// Ctrl-C and SIGTERM: before the first sample they end the process; then the first is a request to stop, the second ends at once.
#pragma once
#include <atomic>

namespace stokes {

/// From now on SIGINT and SIGTERM end the process with kExitInterrupted: there is nothing to save yet.
void exit_on_interrupt();
/// From now on the first of them only sets a flag; any second one ends the process by the signal.
void catch_interrupts();
/// From now on signals are another process's affair: the two functions above do nothing, and a count above 0 is the request to stop.
void take_interrupts_from(const std::atomic<int>& stops);
bool interrupted();

}  // namespace stokes
