// Cuts a render into launches of about equal time. Knows pixels, samples and seconds; no OpenCL.
#pragma once
#include <cstdint>

namespace stokes {

/// The order of launches: whole sample passes, as many at a time as fit the target time, or, where one pass alone takes longer, ranges
/// of pixels of one pass after the other. The image does not depend on it, because the film's sums are integers.
class LaunchPlan {
 public:
  struct Range {
    std::uint32_t pixel_begin, pixel_end;
    std::uint32_t sample_begin, sample_end;
    std::uint64_t paths() const { return std::uint64_t(pixel_end - pixel_begin) * (sample_end - sample_begin); }
  };

  /// `first_paths` is the size of the first launch, made before any speed is known; later ones grow at most fourfold at a time, and
  /// to `most_paths` at most (a pass that is begun may exceed it by a quarter).
  LaunchPlan(std::uint32_t pixels, std::uint32_t sample_begin, std::uint32_t sample_end, std::uint64_t first_paths, std::uint64_t most_paths,
             double target_seconds);

  bool done() const { return sample_ == end_ || pixels_ == 0; }
  /// The next launch; not to be called when done.
  Range next() const;
  /// Tells that `range`, which next() gave, has run and how long it took.
  void complete(const Range& range, double seconds);
  /// Changes the target time of the launches to come.
  void aim(double target_seconds) { target_seconds_ = target_seconds; }

  /// Whether every pixel now has the same number of samples.
  bool between_passes() const { return pixel_ == 0; }
  /// The samples [begin, whole_passes_end) are done in every pixel.
  std::uint32_t whole_passes_end() const { return sample_; }
  /// Estimates, 0 while no launch has run.
  double seconds_per_pass() const { return rate_ > 0 ? pixels_ / rate_ : 0; }
  double seconds_to_pass_end() const { return rate_ > 0 && pixel_ > 0 ? (pixels_ - pixel_) / rate_ : 0; }

 private:
  std::uint32_t pixels_, sample_, end_;
  std::uint32_t pixel_ = 0;  // first pixel of pass sample_ that is not done
  std::uint64_t most_paths_;
  std::uint64_t budget_;  // paths of the next launch
  double target_seconds_;
  double rate_ = 0;  // paths per second, of the last launch
};

}  // namespace stokes
