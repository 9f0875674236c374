// Tells the user how far a render is, on stderr. Knows samples and seconds, nothing of how they are rendered.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace stokes {

enum class ProgressMode { Auto, Plain, Json, None };

class ProgressReport {
 public:
  /// `total`: pixel samples of the whole render, of which `already` were there before (a resumed checkpoint). Auto is one rewritten
  /// line on a terminal, else a line every 10 s.
  ProgressReport(ProgressMode mode, std::uint64_t total, std::uint64_t already, int samples_per_pixel);
  /// `done` counts from the start of this process's work, `rays` likewise (0: not known).
  void update(std::uint64_t done, std::uint64_t rays);
  /// Ends the rewritten line, so that other messages start on their own.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void print(std::uint64_t done, std::uint64_t rays, double seconds);
  ProgressMode mode_;
  bool rewrite_ = false, line_open_ = false;
  std::uint64_t total_, already_;
  int samples_per_pixel_;
  Clock::time_point start_, last_;
};

}  // namespace stokes
