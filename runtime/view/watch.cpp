// Notices that files have changed. See watch.h.
#include "view/watch.h"

#include <sys/stat.h>

#include <utility>

namespace stokes {

FileWatch::Stamp FileWatch::stamp_of(const std::string& path) {
  struct stat s = {};
  if (stat(path.c_str(), &s) != 0) return {};  // gone, or not there yet: a stamp like any other
  return {s.st_mtim.tv_sec, s.st_mtim.tv_nsec, s.st_size, static_cast<std::int64_t>(s.st_ino)};
}

void FileWatch::watch(const std::vector<std::string>& paths) {
  std::map<std::string, Stamp> stamps;
  for (const std::string& path : paths) {
    const auto known = stamps_.find(path);
    stamps[path] = known != stamps_.end() ? known->second : stamp_of(path);
  }
  stamps_ = std::move(stamps);
}

bool FileWatch::changed() {
  bool differs = false;
  for (auto& [path, stamp] : stamps_) {
    const Stamp now = stamp_of(path);
    differs |= !(now == stamp);
    stamp = now;
  }
  if (differs) {
    moving_ = true;
    return false;
  }
  return std::exchange(moving_, false);
}

}  // namespace stokes
