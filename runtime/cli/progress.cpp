// Tells the user how far a render is, on stderr. Knows samples and seconds, nothing of how they are rendered.
#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace stokes {
namespace {

constexpr double kRewriteSeconds = 0.1, kLineSeconds = 10;

std::string clock_text(double seconds) {
  const long s = static_cast<long>(seconds + 0.5);
  char text[32];
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

}  // namespace

ProgressReport::ProgressReport(ProgressMode mode, std::uint64_t total, std::uint64_t already, int samples_per_pixel)
    : mode_(mode), total_(std::max<std::uint64_t>(1, total)), already_(already), samples_per_pixel_(samples_per_pixel), start_(Clock::now()), last_(start_) {
  rewrite_ = mode == ProgressMode::Auto && isatty(STDERR_FILENO);
}

void ProgressReport::update(std::uint64_t done, std::uint64_t rays) {
  if (mode_ == ProgressMode::None) return;
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  const double every = rewrite_ ? kRewriteSeconds : mode_ == ProgressMode::Json ? 1.0 : kLineSeconds;
  if (since < every && !(mode_ == ProgressMode::Json && already_ + done >= total_)) return;
  last_ = now;
  print(done, rays, std::chrono::duration<double>(now - start_).count());
}

void ProgressReport::print(std::uint64_t done, std::uint64_t rays, double seconds) {
  const double fraction = std::min(1.0, static_cast<double>(already_ + done) / static_cast<double>(total_));
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  const double left = rate > 0 ? static_cast<double>(total_ - std::min(total_, already_ + done)) / rate : 0;
  const double mrays = seconds > 0 ? static_cast<double>(rays) / seconds * 1e-6 : 0;
  const int samples = static_cast<int>(fraction * samples_per_pixel_);
  if (mode_ == ProgressMode::Json) {
    std::fprintf(stderr, "{\"progress\":%.6f,\"samples\":%d,\"samples_total\":%d,\"mrays_per_second\":%.3f,\"elapsed\":%.3f,\"eta\":%.3f}\n",
                 fraction, samples, samples_per_pixel_, mrays, seconds, left);
    return;
  }
  char rays_text[32] = "";
  if (rays > 0) std::snprintf(rays_text, sizeof rays_text, "  %.2f Mray/s", mrays);
  if (!rewrite_) {
    std::fprintf(stderr, "%5.1f %%  %d/%d samples%s  elapsed %s  left %s\n", 100 * fraction, samples, samples_per_pixel_, rays_text,
                 clock_text(seconds).c_str(), clock_text(left).c_str());
    return;
  }
  constexpr int kBar = 30;
  std::string bar(static_cast<std::size_t>(fraction * kBar), '=');
  if (bar.size() < kBar) bar += '>';
  bar.resize(kBar, ' ');
  std::fprintf(stderr, "\r[%s] %5.1f %%  %d/%d samples%s  %s  ETA %s \x1b[K", bar.c_str(), 100 * fraction, samples, samples_per_pixel_,
               rays_text, clock_text(seconds).c_str(), clock_text(left).c_str());
  line_open_ = true;
}

void ProgressReport::finish() {
  if (line_open_) std::fputs("\r\x1b[K", stderr);
  line_open_ = false;
}

}  // namespace stokes
