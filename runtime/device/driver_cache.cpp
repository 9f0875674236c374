// The folder's life: made and locked, set in the environment, removed at exit; those whose lock is free belong to nobody.
#include "device/driver_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "device/binary_cache.h"

namespace stokes {

namespace {

namespace fs = std::filesystem;

constexpr char kPrefix[] = "stokes-driver-";
constexpr std::chrono::minutes kYoung{1};  // a folder so new may still be without the lock of its owner

/// A folder of this process alone, held by a lock as long as the process lives.
class PrivateFolder {
 public:
  explicit PrivateFolder(const fs::path& parent) {
    std::error_code failure;
    fs::create_directories(parent, failure);
    std::string name = (parent / (kPrefix + std::string("XXXXXX"))).string();
    if (!::mkdtemp(name.data())) return;
    path_ = name;
    lock_ = ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
  }
  ~PrivateFolder() {
    // A child of fork has the folder from its parent, to whom it belongs.
    if (path_.empty() || owner_ != ::getpid()) return;
    std::error_code failure;
    fs::remove_all(path_, failure);
    ::close(lock_);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int lock_ = -1;
  pid_t owner_ = ::getpid();
};

void remove_orphans(const fs::path& parent) {
  std::error_code failure;
  std::vector<fs::path> orphans;
  for (const auto& entry : fs::directory_iterator(parent, failure)) {
    if (entry.path().filename().string().compare(0, sizeof kPrefix - 1, kPrefix) != 0 || !entry.is_directory(failure)) continue;
    const auto written = entry.last_write_time(failure);
    if (failure || fs::file_time_type::clock::now() - written < kYoung) continue;
    const int fd = ::open(entry.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0) continue;
    struct stat owner = {};
    if (::fstat(fd, &owner) == 0 && owner.st_uid == ::geteuid() && ::flock(fd, LOCK_EX | LOCK_NB) == 0) orphans.push_back(entry.path());
    ::close(fd);
  }
  for (const fs::path& orphan : orphans) fs::remove_all(orphan, failure);
}

std::vector<fs::path> candidate_parents(DriverCachePlace place) {
  std::vector<fs::path> parents;
  const char* asked = std::getenv("POCL_CACHE_DIR");
  if (place == DriverCachePlace::Usual) {
    if (asked && asked[0]) parents.emplace_back(asked);
    if (!cache_folder().empty()) parents.emplace_back(cache_folder());
  }
  std::error_code failure;
  const fs::path temporary = fs::temp_directory_path(failure);
  if (!failure) parents.push_back(temporary);
  return parents;
}

}  // namespace

void isolate_driver_cache(DriverCachePlace place) {
  static std::once_flag once;
  std::call_once(once, [place] {
    // Made before the driver is loaded, so destroyed after the driver's own work at exit.
    static std::unique_ptr<PrivateFolder> folder;
    for (const fs::path& parent : candidate_parents(place)) {
      folder = std::make_unique<PrivateFolder>(parent);
      if (folder->path().empty()) continue;
      remove_orphans(parent);
      ::setenv("POCL_CACHE_DIR", folder->path().c_str(), 1);
      return;
    }
  });
}

}  // namespace stokes
