// Other programs, started with words and waited for. Knows nothing of what they do.
#pragma once
#include <string>
#include <vector>

namespace stokes {

/// This program's own file.
std::string own_executable();

/// Runs a program (looked for in PATH) and returns its exit code, or 128 and the signal's number. It gets a process group of its own, so
/// that a terminal's Ctrl-C reaches it once: SIGINT and SIGTERM sent to us are passed on. It gets SIGTERM when we end first. Throws
/// std::system_error when it cannot be started.
int run_process(const std::vector<std::string>& words);

/// Becomes another program. Throws std::system_error when it cannot be started.
[[noreturn]] void become_process(const std::vector<std::string>& words);

/// Asks the kernel to end this process, and what it becomes, when its parent ends (on Linux: the thread that started it). A parent that has
/// ended before the call is not noticed: its id cannot tell, for the first process of a container is a parent like any other.
void end_with_parent();

}  // namespace stokes
