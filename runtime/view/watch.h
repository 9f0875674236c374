// Notices that files have changed, however an editor writes them. Knows paths and their stamps, not what is in them.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace stokes {

/// Polled: editors write in place, rename over, or delete and create anew, on file systems that tell and that do not tell.
class FileWatch {
 public:
  /// Watches these from now on; those watched before keep their stamps.
  void watch(const std::vector<std::string>& paths);
  /// True once after every change, when the files have since stood still for one further call: a half-written file is not worth reading.
  bool changed();

 private:
  struct Stamp {
    std::int64_t seconds = 0, nanoseconds = 0, size = -1, inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::string& path);
  std::map<std::string, Stamp> stamps_;
  bool moving_ = false;
};

}  // namespace stokes
