// Ctrl-C and SIGTERM: the first is a request to stop, the second ends the process at once.
#pragma once

namespace stokes {

/// From now on the first SIGINT or SIGTERM only sets a flag; any second one ends the process by the signal.
void catch_interrupts();
bool interrupted();

}  // namespace stokes
