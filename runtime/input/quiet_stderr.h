// Keeps a library from writing to standard error by itself, as libpng does before it reports the same. Knows file descriptors only.
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace stokes {

/// While one of these lives, what is written to standard error is lost, that of other threads too.
class QuietStderr {
 public:
  QuietStderr() {
    std::fflush(stderr);
    kept_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~QuietStderr() {
    std::fflush(stderr);
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_;
};

}  // namespace stokes
