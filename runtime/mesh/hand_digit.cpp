// A digit is an elliptic section swept along its bones; the section follows a smooth profile over the whole length, so that joints swell and
// pads rise without seams. Each bone sweeps its own part and the parts are joined smoothly where they bend.
#include "mesh/hand_digit.h"

#include <numbers>

namespace stokes {

using namespace sdf;

namespace {

constexpr double kJoin = 1.6;  // mm, how widely two bones' parts are blended; it adds a quarter of that to the joint

Rotation half_bend(const Bone& previous, double flexion) { return previous.frame * rotation(0.5 * flexion * 180 / std::numbers::pi, 0, 0); }

struct Crease {
  double y, depth, width;
  double side;  // +1 palm, -1 back
  double bow;
};

double cut_creases(double d, Vec3d q, double half_width, std::initializer_list<Crease> creases) {
  for (const Crease& c : creases)
    d += c.depth * bump(q.y - c.y - c.bow * q.x * q.x, c.width) * smooth_step(half_width * 0.1, half_width * 0.8, q.z * c.side);
  return d;
}

// Cubic through b and c whose slopes never overshoot (the harmonic mean of the neighbouring slopes; Fritsch & Butland 1984).
double slope(double h0, double h1, double s0, double s1) { return s0 * s1 <= 0 ? 0 : (h0 + h1) / (h0 / s0 + h1 / s1); }

}  // namespace

HandDigit::HandDigit(const Digit& digit, const FingerShape& f)
    : digit_(digit), tip_(f.radii[5]), nail_width_(f.nail_width), nail_length_(f.nail_length), thumb_(false) {
  const auto& [rb, r1, rp, r2, rd, rt] = f.radii;
  const auto& [L0, L1, L2] = f.lengths;
  begins_ = {0, L0, L0 + L1, L0 + L1 + L2};
  sections_ = {{-0.1 * L0, rb * 1.02, rb * 0.92, rb * 1.0},
               {L0 * 0.28, rb * 0.97, rb * 0.90, rb * 1.02},
               {L0 * 0.62, r1 * 1.0, r1 * 0.92, r1 * 1.10},
               {L0, rp * 0.97, rp * 0.93, rp * 0.92},
               {L0 + L1 * 0.50, r2 * 1.02, r2 * 0.93, r2 * 1.10},
               {L0 + L1, rd * 0.98, rd * 0.88, rd * 0.92},
               {L0 + L1 + L2 * 0.38, rd * 0.99, rd * 0.85, rd * 1.06},
               {L0 + L1 + L2 * 0.62, rt * 1.04, rt * 0.84, rt * 1.10},
               {L0 + L1 + L2 - rt, rt * 0.97, rt * 0.74, rt * 0.94}};
}

HandDigit::HandDigit(const Digit& digit, const ThumbShape& f)
    : digit_(digit), tip_(f.radii[4]), nail_width_(f.nail_width), nail_length_(f.nail_length), thumb_(true) {
  const auto& [rc, rm, r1, ri, rt] = f.radii;
  const auto& [L0, L1, L2] = f.lengths;
  begins_ = {0, L0, L0 + L1, L0 + L1 + L2};
  sections_ = {{0, rc, rc, rc},
               {L0 * 0.75, rm * 1.05, rm * 0.98, rm * 1.08},
               {L0, rm * 1.03, rm * 0.96, rm * 0.98},
               {L0 + L1 * 0.50, r1 * 0.95, r1 * 0.90, r1 * 1.08},
               {L0 + L1, ri * 1.02, ri * 0.92, ri * 0.92},
               {L0 + L1 + L2 * 0.36, ri * 1.08, ri * 0.79, ri * 1.00},
               {L0 + L1 + L2 * 0.62, rt * 1.16, rt * 0.90, rt * 1.10},
               {L0 + L1 + L2 - rt, rt * 0.98, rt * 0.72, rt * 0.90}};
}

Section HandDigit::section(double y) const {
  if (y <= sections_.front().y) return sections_.front();
  if (y >= sections_.back().y) return sections_.back();
  std::size_t i = 0;
  while (sections_[i + 1].y < y) i++;
  const Section &b = sections_[i], &c = sections_[i + 1], &a = i > 0 ? sections_[i - 1] : b, &e = i + 2 < sections_.size() ? sections_[i + 2] : c;
  const double h = c.y - b.y, u = (y - b.y) / h;
  const auto value = [&](double Section::* m) {
    const double s = (c.*m - b.*m) / h;
    const double sb = &a == &b ? s : slope(b.y - a.y, h, (b.*m - a.*m) / (b.y - a.y), s);
    const double sc = &e == &c ? s : slope(h, e.y - c.y, s, (e.*m - c.*m) / (e.y - c.y));
    return b.*m * (1 + 2 * u) * (1 - u) * (1 - u) + c.*m * u * u * (3 - 2 * u) + h * u * (1 - u) * (sb * (1 - u) - sc * u);
  };
  return {y, value(&Section::width), value(&Section::back), value(&Section::palm)};
}

double HandDigit::bone(int i, Vec3d q) const {
  const double end = i == 2 ? sections_.back().y - begins_[2] : digit_.bones[i].length;
  const double along = std::clamp(q.y, 0.0, end);
  const Section s = section(begins_[i] + along);
  const double height = q.z > 0 ? s.palm : s.back, cap = i == 2 && q.y > 0 ? tip_ : s.width;
  const Vec3d a{q.x / s.width, (q.y - along) / cap, q.z / height}, b{a.x / s.width, a.y / cap, a.z / height};
  const double k = length(a), smallest = std::min(s.width, height);
  return k < 1e-6 ? -smallest : std::max(k * (k - 1) / length(b), -smallest);
}

// The nail's plate in the end bone's frame: a bent shell let into the back of the tip.
double HandDigit::nail(double d, Vec3d q) const {
  const double length = digit_.bones[2].length, radius = 0.62 * nail_width_, middle = length - 0.5 * nail_length_ - 1.3;
  const double flesh = section(begins_[2] + middle).back, fall = (section(begins_[2] + middle - 3).back - section(begins_[2] + middle + 3).back) / 6;
  const double dy = q.y - middle, drop = std::clamp(dy, 0.0, 8.0);
  const double zz = q.z + flesh - radius - 0.1 - fall * dy - 0.022 * drop * drop;
  const double u = radius * std::atan2(q.x, -zz), w = std::hypot(q.x, zz) - radius;
  const double corner = 0.42 * nail_width_;
  const double ax = std::abs(u) - (0.5 * nail_width_ - corner), ay = std::abs(dy) - (0.5 * nail_length_ - corner);
  const double outline = std::hypot(std::max(ax, 0.0), std::max(ay, 0.0)) + std::min(std::max(ax, ay), 0.0) - corner;
  const double far = (1 - smooth_step(-2, 3, -q.z)) * 4;
  d = smooth_max(d, -(smooth_max(outline, -0.25 - w, 0.5) + far), 0.8);                                                          // bed
  d += 0.3 * bump(outline - 0.6, 1.8) * smooth_step(0.5, 3, -q.z) * smooth_step(-0.5 * nail_length_, -0.3 * nail_length_, -dy);  // groove
  return smooth_min(d, smooth_max(outline - 0.25, std::abs(w + 0.85) - 0.85, 0.7) + far, 0.4);
}

double HandDigit::creases(double d, Vec3d p, Vec3d q0) const {
  const Bone* b = digit_.bones.data();
  const Vec3d h1 = half_bend(b[0], digit_.flexion[1]).to_local(p - b[1].origin), h2 = half_bend(b[1], digit_.flexion[2]).to_local(p - b[2].origin);
  const double w1 = section(begins_[1]).width, w2 = section(begins_[2]).width;
  if (thumb_) {
    d = cut_creases(d, h2, w2, {{0.8, 0.60, 1.6, 1, 0.004}, {-2.4, 0.35, 1.3, 1, -0.004}});
    d = cut_creases(d, h1, w1, {{1.0, 0.40, 1.8, 1, 0}});
    return cut_creases(d, h2, w2, {{-4.0, 0.08, 1.4, -1, -0.018}, {-1.5, 0.2, 1.4, -1, -0.018}, {0.9, 0.22, 1.4, -1, 0.018}, {3.2, 0.1, 1.4, -1, 0.018}});
  }
  d = cut_creases(d, h1, w1, {{1.2, 0.50, 1.4, 1, 0.004}, {-1.7, 0.35, 1.2, 1, -0.004}});
  d = cut_creases(d, h2, w2, {{0, 0.45, 1.3, 1, 0.004}});
  d = cut_creases(d, h1, w1, {{-4.4, 0.07, 1.3, -1, -0.03}, {-2.1, 0.16, 1.2, -1, -0.022}, {0.2, 0.20, 1.3, -1, -0.004}, {2.3, 0.13, 1.2, -1, 0.024}});
  d = cut_creases(d, h2, w2, {{-1.4, 0.09, 1.0, -1, -0.016}, {0.6, 0.12, 1.0, -1, 0.012}});
  return cut_creases(d, q0, section(begins_[1] * 0.4).width, {{begins_[1] * 0.39, 0.55, 1.6, 1, 0.004}});
}

double HandDigit::operator()(Vec3d p) const {
  const Vec3d q0 = digit_.bones[0].local(p), q2 = digit_.bones[2].local(p);
  double d = smooth_min(bone(0, q0), bone(1, digit_.bones[1].local(p)), kJoin);
  d = smooth_min(d, bone(2, q2), kJoin);
  if (d > 8) return d;
  return creases(nail(d, q2), p, q0);
}

}  // namespace stokes
