// Nearest points on Catmull-Rom splines.
#include "mesh/spline_tube.h"

namespace stokes::sdf {

namespace {

template <typename T>
std::array<T, 4> catmull_rom(T a, T b, T c, T d) {
  return {b, (c - a) * 0.5, (a * 2.0 - b * 5.0 + c * 4.0 - d) * 0.5, (b * 3.0 - a - c * 3.0 + d) * 0.5};
}

template <typename T>
T at(const std::array<T, 4>& k, double t) {
  return k[0] + (k[1] + (k[2] + k[3] * t) * t) * t;
}

}  // namespace

SplineTube::SplineTube(const std::vector<TubePoint>& control) {
  const int count = static_cast<int>(control.size());
  auto position = [&](int i) { return Vec3d{control[i].x, control[i].y, control[i].z}; };
  for (int i = 0; i + 1 < count; i++) {
    // Beyond the ends the curve goes on straight.
    const Vec3d b = position(i), c = position(i + 1), a = i > 0 ? position(i - 1) : b * 2.0 - c, d = i + 2 < count ? position(i + 2) : c * 2.0 - b;
    const double rb = control[i].r, rc = control[i + 1].r, ra = i > 0 ? control[i - 1].r : 2 * rb - rc, rd = i + 2 < count ? control[i + 2].r : 2 * rc - rb;
    pieces_.push_back({catmull_rom(a, b, c, d), catmull_rom(ra, rb, rc, rd)});
    for (int s = 0; s < kSamples; s++) samples_.push_back(at(pieces_.back().position, static_cast<double>(s) / kSamples));
  }
  samples_.push_back(position(count - 1));
  // The ball's middle is the samples'. Between closely spaced points the curve strays from them by far less than a millimetre.
  for (const Vec3d& s : samples_) ball_center_ += s / static_cast<double>(samples_.size());
  constexpr int kClose = 32;
  for (const Piece& piece : pieces_)
    for (int s = 0; s <= kClose; s++) {
      const double t = static_cast<double>(s) / kClose;
      ball_radius_ = std::max(ball_radius_, length(at(piece.position, t) - ball_center_) + at(piece.radius, t) + 1);
    }
}

double SplineTube::join(double d, Vec3d p, double k) const {
  return length(p - ball_center_) - ball_radius_ >= d + k ? d : smooth_min(d, (*this)(p), k);
}

double SplineTube::operator()(Vec3d p) const {
  std::size_t nearest = 0;
  double smallest = 1e300;
  for (std::size_t i = 0; i < samples_.size(); i++)
    if (const double s = length_squared(p - samples_[i]); s < smallest) smallest = s, nearest = i;
  const double end = static_cast<double>(pieces_.size()), reach = 1.0 / kSamples;
  double u = static_cast<double>(nearest) / kSamples;
  for (int step = 0; step < 2; step++) {
    const std::size_t i = std::min(static_cast<std::size_t>(u), pieces_.size() - 1);
    const double t = u - static_cast<double>(i);
    const auto& k = pieces_[i].position;
    const Vec3d q = at(k, t) - p, slope = k[1] + (k[2] * 2.0 + k[3] * (3 * t)) * t, bend = k[2] * 2.0 + k[3] * (6 * t);
    const double speed = length_squared(slope);
    u = std::clamp(u - std::clamp(dot(q, slope) / std::max(speed + dot(q, bend), 0.3 * speed), -reach, reach), 0.0, end);
  }
  const std::size_t i = std::min(static_cast<std::size_t>(u), pieces_.size() - 1);
  const double t = u - static_cast<double>(i);
  return length(p - at(pieces_[i].position, t)) - at(pieces_[i].radius, t);
}

}  // namespace stokes::sdf
