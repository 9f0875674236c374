// Replaces a file as a whole or not at all: temporary file beside it, fsync, rename. Knows nothing of what is written.
#include "image/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "image/error.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw OutputError(path + ": cannot be written: " + cause);
}

/// The file that will really be replaced, and the checks that need no writing.
fs::path resolve_target(const std::string& path) {
  std::error_code ec;
  fs::path target = path;
  for (int depth = 0; fs::is_symlink(fs::symlink_status(target, ec)) && depth < 40; depth++) {
    const fs::path link = fs::read_symlink(target, ec);
    if (ec) fail(path, ec.message());
    target = link.is_absolute() ? link : target.parent_path() / link;
  }
  const fs::file_status status = fs::status(target, ec);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "it is not a regular file");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ec)) fail(path, "there is no folder " + folder.string());
  return target;
}

fs::path temporary_beside(const fs::path& target) {
  const std::string name = "." + target.filename().string() + "." + std::to_string(::getpid()) + ".tmp";
  return target.has_parent_path() ? target.parent_path() / name : fs::path(name);
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
  sync(target.has_parent_path() ? target.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY | O_CLOEXEC, false, path);
}

void require_writable(const std::string& path) {
  const fs::path temporary = temporary_beside(resolve_target(path));
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (fd < 0) fail(path, std::strerror(errno));
  ::close(fd);
  ::unlink(temporary.c_str());
}

void write_bytes(const std::string& path, const std::string& bytes) {
  replace_file(path, [&](const std::string& temporary) {
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
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
    ::close(fd);
  });
}

}  // namespace stokes
