// Signed distance fields (negative inside) and the primitives that the head and the hand are built from.
#pragma once
#include <functional>
#include <vector>

#include "math/vec.h"

namespace stokes {

/// Signed distance, or a value close to it, at a point.
using Field = std::function<double(Vec3d)>;

/// A field on a regular grid: value(i, j, k) belongs to origin + step (i, j, k).
struct Grid {
  Vec3d origin;
  double step = 1;
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> values;
  std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(k) * ny + j) * nx + i; }
  float at(int i, int j, int k) const { return values[index(i, j, k)]; }
  Vec3d point(int i, int j, int k) const { return origin + Vec3d{i * step, j * step, k * step}; }
};

/// Samples a field over a box. Blocks whose middle lies farther from the level than the field can reach (its slope is at most
/// `lipschitz`) keep the middle's value, so only the neighbourhood of the surface is evaluated in full.
Grid sample_field(const Field& field, Vec3d lo, Vec3d hi, double step, double level = 0, double lipschitz = 1.8);

namespace sdf {

/// A rotation by degrees about x, then y, then z; the columns are the local axes.
struct Rotation {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3d to_local(Vec3d v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3d to_world(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
};
Rotation rotation(double rx, double ry, double rz);
Rotation operator*(const Rotation& a, const Rotation& b);

/// Smooth minimum and maximum with compact support: exact where |a - b| >= k, off by k / 4 at most.
double smooth_min(double a, double b, double k);
double smooth_max(double a, double b, double k);
/// Takes the tool away from d, smoothly.
double carve(double d, double tool, double k);
/// 0 at a, 1 at b, smooth in between; a may exceed b.
double smooth_step(double a, double b, double x);
/// An even bell: 1 at 0, 0 beyond w.
double bump(double t, double w);

/// First-order distance to an ellipsoid with radii r, never deeper than its smallest radius.
double ellipsoid(Vec3d p, Vec3d center, Vec3d radii);
double ellipsoid(Vec3d p, Vec3d center, Vec3d radii, const Rotation& r);
/// Capsule whose radius changes linearly from ra at a to rb at b.
double capsule(Vec3d p, Vec3d a, Vec3d b, double ra, double rb);

/// A point of a tube: position and radius.
struct TubePoint {
  double x, y, z, r;
};
/// A bent, tapered capsule along a Catmull-Rom spline, resampled once.
class Tube {
 public:
  Tube(const std::vector<TubePoint>& control, int segments);
  double operator()(Vec3d p) const;

 private:
  std::vector<TubePoint> points_;
};

/// A spline in the xy plane; the distance of (x, y) to it, and the parameter 0..1 of the nearest point.
class Curve2 {
 public:
  Curve2(const std::vector<std::array<double, 2>>& control, int segments);
  double distance(double x, double y, double* parameter = nullptr) const;

 private:
  std::vector<std::array<double, 2>> points_;
};

}  // namespace sdf
}  // namespace stokes
