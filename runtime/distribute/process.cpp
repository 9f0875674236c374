// Other programs, started with words and waited for.
#include "distribute/process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

namespace stokes {
namespace {

volatile std::sig_atomic_t child = 0;

void pass_on(int number) {
  if (child > 0) kill(static_cast<pid_t>(child), number);
}

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> result;
  for (const std::string& word : words) result.push_back(const_cast<char*>(word.c_str()));
  result.push_back(nullptr);
  return result;
}

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

void set_handlers(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

std::string own_executable() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

int run_process(const std::vector<std::string>& words) {
  // The pipe closes when the program has started, or carries why it has not.
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) fail(words[0]);
  const std::vector<char*> arguments = pointers(words);
  set_handlers(pass_on);
  const pid_t parent = getpid(), pid = fork();
  if (pid < 0) fail(words[0]);
  if (pid == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    set_handlers(SIG_DFL);
    execvp(arguments[0], arguments.data());
    const int code = errno;
    _exit(write(report[1], &code, sizeof code) == sizeof code ? 127 : 126);
  }
  child = pid;
  close(report[1]);
  int code = 0;
  const bool failed = read(report[0], &code, sizeof code) == sizeof code;
  close(report[0]);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  child = 0;
  set_handlers(SIG_DFL);
  if (failed) {
    errno = code;
    fail(words[0]);
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

void become_process(const std::vector<std::string>& words) {
  execvp(words[0].c_str(), pointers(words).data());
  fail(words[0]);
}

void end_with_parent() { prctl(PR_SET_PDEATHSIG, SIGKILL); }

}  // namespace stokes
