// Distance primitives and the sampling of fields on grids.
#include "mesh/field.h"

#include <numbers>
#include <thread>

namespace stokes {

namespace {

constexpr int kBlock = 8;  // grid points along the side of the largest block that is decided as one

// Fills the block of n points a side that begins at (i0, j0, k0): with one value when the level is far, else by its eight parts.
void sample_block(const Field& field, Grid& g, int i0, int j0, int k0, int n, double level, double lipschitz) {
  if (i0 >= g.nx || j0 >= g.ny || k0 >= g.nz) return;
  if (n == 1) {
    g.values[g.index(i0, j0, k0)] = static_cast<float>(field(g.point(i0, j0, k0)));
    return;
  }
  const int i1 = std::min(i0 + n, g.nx), j1 = std::min(j0 + n, g.ny), k1 = std::min(k0 + n, g.nz);
  const Vec3d a = g.point(i0, j0, k0), b = g.point(i1 - 1, j1 - 1, k1 - 1);
  const double middle = field((a + b) * 0.5);
  // One more step on every side: the neighbouring block's points must agree on the sign.
  if (std::abs(middle - level) > lipschitz * (0.5 * length(b - a) + g.step)) {
    for (int k = k0; k < k1; k++)
      for (int j = j0; j < j1; j++)
        for (int i = i0; i < i1; i++) g.values[g.index(i, j, k)] = static_cast<float>(middle);
    return;
  }
  const int h = n > 2 ? n / 2 : 1;
  for (int part = 0; part < 8; part++)
    sample_block(field, g, i0 + (part & 1) * h, j0 + ((part >> 1) & 1) * h, k0 + (part >> 2) * h, h, level, lipschitz);
}

}  // namespace

Grid sample_field(const Field& field, Vec3d lo, Vec3d hi, double step, double level, double lipschitz) {
  Grid g;
  g.origin = lo;
  g.step = step;
  const Vec3d n = (hi - lo) / step;
  g.nx = static_cast<int>(std::ceil(n.x)) + 1;
  g.ny = static_cast<int>(std::ceil(n.y)) + 1;
  g.nz = static_cast<int>(std::ceil(n.z)) + 1;
  g.values.resize(static_cast<std::size_t>(g.nx) * g.ny * g.nz);
  const int bx = (g.nx + kBlock - 1) / kBlock, by = (g.ny + kBlock - 1) / kBlock, bz = (g.nz + kBlock - 1) / kBlock;
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> pool;
  for (unsigned t = 0; t < threads; t++)
    pool.emplace_back([&, t] {
      for (int k = static_cast<int>(t); k < bz; k += static_cast<int>(threads))
        for (int j = 0; j < by; j++)
          for (int i = 0; i < bx; i++) sample_block(field, g, i * kBlock, j * kBlock, k * kBlock, kBlock, level, lipschitz);
    });
  pool.clear();
  return g;
}

namespace sdf {

Rotation operator*(const Rotation& a, const Rotation& b) { return {a.to_world(b.x), a.to_world(b.y), a.to_world(b.z)}; }

Rotation rotation(double rx, double ry, double rz) {
  const double to_radians = std::numbers::pi / 180;
  const double a = rx * to_radians, b = ry * to_radians, c = rz * to_radians;
  const Rotation x{{1, 0, 0}, {0, std::cos(a), std::sin(a)}, {0, -std::sin(a), std::cos(a)}};
  const Rotation y{{std::cos(b), 0, -std::sin(b)}, {0, 1, 0}, {std::sin(b), 0, std::cos(b)}};
  const Rotation z{{std::cos(c), std::sin(c), 0}, {-std::sin(c), std::cos(c), 0}, {0, 0, 1}};
  return z * y * x;
}

double smooth_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * k);
}
double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }
double carve(double d, double tool, double k) { return smooth_max(d, -tool, k); }

double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
double bump(double t, double w) {
  const double u = std::max(1 - (t / w) * (t / w), 0.0);
  return u * u;
}

double ellipsoid(Vec3d p, Vec3d center, Vec3d radii) {
  const Vec3d q = p - center;
  const Vec3d s{q.x / radii.x, q.y / radii.y, q.z / radii.z};
  const Vec3d t{s.x / radii.x, s.y / radii.y, s.z / radii.z};
  const double k0 = length(s), smallest = std::min({radii.x, radii.y, radii.z});
  if (k0 < 1e-6) return -smallest;
  return std::max(k0 * (k0 - 1) / std::sqrt(length_squared(t) + 1e-12), -smallest);
}
double ellipsoid(Vec3d p, Vec3d center, Vec3d radii, const Rotation& r) { return ellipsoid(r.to_local(p - center), {}, radii); }

double capsule(Vec3d p, Vec3d a, Vec3d b, double ra, double rb) {
  const Vec3d ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / length_squared(ab), 0.0, 1.0);
  return length(p - a - ab * t) - (ra + t * (rb - ra));
}

namespace {

// Catmull-Rom through rows of N numbers, resampled to n + 1 points, uniform in the parameter.
template <std::size_t N>
std::vector<std::array<double, N>> catmull_rom(std::vector<std::array<double, N>> rows, int n) {
  std::array<double, N> first, last;
  for (std::size_t c = 0; c < N; c++) {
    first[c] = 2 * rows[0][c] - rows[1][c];
    last[c] = 2 * rows[rows.size() - 1][c] - rows[rows.size() - 2][c];
  }
  rows.insert(rows.begin(), first);
  rows.push_back(last);
  const int pieces = static_cast<int>(rows.size()) - 3;
  std::vector<std::array<double, N>> out;
  for (int s = 0; s <= n; s++) {
    const double u = static_cast<double>(pieces) * s / n;
    const int i = std::min(static_cast<int>(u), pieces - 1);
    const double t = u - i;
    std::array<double, N> point;
    for (std::size_t c = 0; c < N; c++) {
      const double a = rows[i][c], b = rows[i + 1][c], d = rows[i + 2][c], e = rows[i + 3][c];
      point[c] = 0.5 * (2 * b + (d - a) * t + (2 * a - 5 * b + 4 * d - e) * t * t + (3 * b - a - 3 * d + e) * t * t * t);
    }
    out.push_back(point);
  }
  return out;
}

}  // namespace

Tube::Tube(const std::vector<TubePoint>& control, int segments) {
  std::vector<std::array<double, 4>> rows;
  for (const TubePoint& p : control) rows.push_back({p.x, p.y, p.z, p.r});
  for (const auto& p : catmull_rom(rows, segments)) points_.push_back({p[0], p[1], p[2], p[3]});
}

double Tube::operator()(Vec3d p) const {
  double d = 1e30;
  for (std::size_t i = 0; i + 1 < points_.size(); i++) {
    const TubePoint &a = points_[i], &b = points_[i + 1];
    d = std::min(d, capsule(p, {a.x, a.y, a.z}, {b.x, b.y, b.z}, a.r, b.r));
  }
  return d;
}

Curve2::Curve2(const std::vector<std::array<double, 2>>& control, int segments) : points_(catmull_rom(control, segments)) {}

double Curve2::distance(double x, double y, double* parameter) const {
  double best = 1e30, at = 0;
  const double n = static_cast<double>(points_.size() - 1);
  for (std::size_t i = 0; i + 1 < points_.size(); i++) {
    const double ax = points_[i][0], ay = points_[i][1], bx = points_[i + 1][0] - ax, by = points_[i + 1][1] - ay;
    const double t = std::clamp(((x - ax) * bx + (y - ay) * by) / (bx * bx + by * by), 0.0, 1.0);
    const double dx = x - ax - t * bx, dy = y - ay - t * by, s = dx * dx + dy * dy;
    if (s < best) best = s, at = (static_cast<double>(i) + t) / n;
  }
  if (parameter) *parameter = at;
  return std::sqrt(best);
}

}  // namespace sdf
}  // namespace stokes
