// Replaces a file as a whole or not at all: temporary file beside it, fsync, rename. Knows nothing of what is written.
#include "image/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "image/error.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw OutputError(path + ": cannot be written: " + cause);
}

constexpr int kMostLinks = 40;  // in a row, as Linux has it

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// The file that will really be replaced, and the checks that need no writing.
fs::path resolve_target(const std::string& path) {
  std::error_code ec;
  fs::path target = path;
  for (int depth = 0; fs::is_symlink(fs::symlink_status(target, ec)); depth++) {
    if (depth == kMostLinks) fail(path, std::strerror(ELOOP));
    const fs::path link = fs::read_symlink(target, ec);
    if (ec) fail(path, ec.message());
    target = link.is_absolute() ? link : target.parent_path() / link;
  }
  const fs::file_status status = fs::status(target, ec);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "it is not a regular file");
  // The folder alone would permit to replace it.
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, ec)) fail(path, "there is no folder " + folder.string());
  return target;
}

/// What the names of a target's temporary files begin with on this machine; the process's number and kEnding follow.
std::string temporary_stem(const fs::path& target) {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return "." + target.filename().string() + "." + host + "-";
}

constexpr char kEnding[] = ".tmp";

fs::path temporary_beside(const fs::path& target) {
  return (folder_of(target) / (temporary_stem(target) + std::to_string(::getpid()) + kEnding)).lexically_normal();
}

/// A new file: where others may write, the name might stand already, as a link to a file of the user's. Returns -1, and errno, where that fails.
int open_temporary(const fs::path& temporary) {
  ::unlink(temporary.c_str());
  return ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/// Whether a process has ended, though its parent may not have looked yet.
bool has_ended(int process) {
  if (::kill(process, 0) != 0 && errno == ESRCH) return true;
  char byte;
  const bool no_program = ::readlink(("/proc/" + std::to_string(process) + "/exe").c_str(), &byte, 1) < 0 && errno == ENOENT;
  return no_program && ::readlink("/proc/self/exe", &byte, 1) > 0;
}

/// Removes the target's temporary files that were left by processes of this machine that are no more.
void remove_stale_temporaries(const fs::path& target) {
  const std::string stem = temporary_stem(target);
  std::vector<fs::path> stale;
  std::error_code ec;
  for (fs::directory_iterator i(folder_of(target), ec), end; !ec && i != end; i.increment(ec)) {
    const std::string name = i->path().filename().string();
    if (name.compare(0, stem.size(), stem) != 0 || i->path().extension() != kEnding) continue;
    const int process = std::atoi(name.c_str() + stem.size());
    if (process > 0 && has_ended(process)) stale.push_back(i->path());
  }
  for (const fs::path& file : stale) fs::remove(file, ec);
}

void sync(const fs::path& file, int flags, bool required, const std::string& path) {
  const int fd = ::open(file.c_str(), flags);
  const bool ok = fd >= 0 && ::fsync(fd) == 0;
  const int code = errno;
  if (fd >= 0) ::close(fd);
  if (!ok && required) fail(path, std::strerror(code));
}

}  // namespace

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  const fs::path target = resolve_target(path), temporary = temporary_beside(target);
  std::error_code ec;
  remove_stale_temporaries(target);
  try {
    write(temporary.string());
    sync(temporary, O_WRONLY | O_CLOEXEC, true, path);
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail(path, std::strerror(errno));
  } catch (const OutputError&) {
    fs::remove(temporary, ec);
    throw;
  } catch (const std::exception& e) {
    fs::remove(temporary, ec);
    fail(path, e.what());
  }
  // The rename itself reaches the disk with the folder; some file systems refuse this, and the file is whole either way.
  sync(folder_of(target), O_RDONLY | O_DIRECTORY | O_CLOEXEC, false, path);
}

void require_writable(const std::string& path) {
  const fs::path target = resolve_target(path), temporary = temporary_beside(target);
  remove_stale_temporaries(target);
  const int fd = open_temporary(temporary);
  if (fd < 0) fail(path, std::strerror(errno));
  ::close(fd);
  ::unlink(temporary.c_str());
}

void write_bytes(const std::string& path, const std::string& bytes) {
  replace_file(path, [&](const std::string& temporary) {
    const int fd = open_temporary(temporary);
    if (fd < 0) throw std::runtime_error(std::strerror(errno));
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        const int code = errno;
        ::close(fd);
        throw std::runtime_error(std::strerror(code));
      }
      done += static_cast<std::size_t>(n);
    }
    if (::close(fd) != 0) throw std::runtime_error(std::strerror(errno));
  });
}

}  // namespace stokes
