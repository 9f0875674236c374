// The launch schedule's arithmetic.
#include "device/launch_plan.h"

#include <algorithm>

namespace stokes {

LaunchPlan::LaunchPlan(std::uint32_t pixels, std::uint32_t sample_begin, std::uint32_t sample_end, std::uint64_t first_paths,
                       std::uint64_t most_paths, double target_seconds)
    : pixels_(pixels),
      sample_(sample_begin),
      end_(std::max(sample_begin, sample_end)),
      most_paths_(std::max<std::uint64_t>(most_paths, 1)),
      budget_(std::clamp<std::uint64_t>(first_paths, 1, most_paths_)),
      target_seconds_(target_seconds) {}

LaunchPlan::Range LaunchPlan::next() const {
  if (pixel_ == 0 && budget_ >= pixels_) {
    const std::uint64_t rounded = budget_ < most_paths_ ? budget_ + pixels_ / 2 : budget_;
    const std::uint64_t passes = std::min<std::uint64_t>(rounded / pixels_, end_ - sample_);
    return {0, pixels_, sample_, sample_ + static_cast<std::uint32_t>(passes)};
  }
  // A rest of less than a quarter launch is not worth one of its own.
  const std::uint64_t rest = pixels_ - pixel_;
  const std::uint64_t count = rest <= budget_ + budget_ / 4 ? rest : budget_;
  return {pixel_, pixel_ + static_cast<std::uint32_t>(count), sample_, sample_ + 1};
}

void LaunchPlan::complete(const Range& range, double seconds) {
  if (range.pixel_end == pixels_) {
    sample_ = range.sample_end;
    pixel_ = 0;
  } else {
    pixel_ = range.pixel_end;
  }
  rate_ = range.paths() / std::max(seconds, 1e-6);
  const double wanted = std::min(rate_ * target_seconds_, 4.0 * range.paths());
  budget_ = static_cast<std::uint64_t>(std::clamp(wanted, 1.0, static_cast<double>(most_paths_)));
}

}  // namespace stokes
