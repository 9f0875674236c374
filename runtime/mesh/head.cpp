// How the parts of the head are joined: skull, features, neck. Each part has its own file.
#include "mesh/head.h"

#include <memory>
#include <numbers>

#include "mesh/head_features.h"
#include "mesh/head_neck.h"
#include "mesh/head_skull.h"

namespace stokes {

using namespace sdf;

namespace {

constexpr Vec3d kPivot{0, -40, -8};
constexpr Vec3d kMastoid{57, -34, -14};

// From the neck's frame, which is the world's, to the tilted head's.
Vec3d to_head(const HeadShape& shape, Vec3d n) {
  const double t = shape.pitch * std::numbers::pi / 180, c = std::cos(t), s = std::sin(t);
  const double dy = n.y - kPivot.y, dz = n.z - kPivot.z;
  return {n.x + shape.asymmetry * std::sin(n.y * 0.035 + 0.6), kPivot.y + c * dy - s * dz, kPivot.z + s * dy + c * dz};
}

}  // namespace

namespace {

struct HeadParts {
  Skull skull;
  Nose nose;
  Mouth mouth;
  Eyes eyes;
  Ear ear;
  Neck neck;
};

}  // namespace

Field head_field(const HeadShape& shape) {
  const double t = shape.pitch * std::numbers::pi / 180, c = std::cos(t), s = std::sin(t);
  const double my = kMastoid.y - kPivot.y, mz = kMastoid.z - kPivot.z;
  const Vec3d mastoid{kMastoid.x, kPivot.y + c * my + s * mz, kPivot.z - s * my + c * mz};
  const auto parts = std::make_shared<const HeadParts>(HeadParts{{}, {}, {}, {}, {}, Neck(mastoid)});
  return [shape, parts](Vec3d n) {
    const Vec3d p = to_head(shape, n);
    const Vec3d m{std::sqrt(p.x * p.x + 1), p.y, p.z};  // a smooth |x|: no crease on the midline
    double d = parts->skull(p, m);
    d = parts->nose(d, p, m);
    d = parts->mouth(d, p, m);
    d = parts->eyes(d, m);
    d = smooth_min(d, parts->neck(n, {m.x, n.y, n.z}), 18);
    d = smooth_min(d, parts->ear(m), 5);
    return smooth_max(d, shape.cut_y - n.y, 3);
  };
}

void head_bounds(const HeadShape& shape, Vec3d& lo, Vec3d& hi) {
  const double e = std::abs(shape.pitch) * 1.2;
  lo = {-106, shape.cut_y - 4, -104 - e};
  hi = {106, 118, 122 + 0.5 * e};
}

std::vector<std::pair<std::string, Field>> head_masks(const HeadShape& shape) {
  auto in_head = [shape](double (*mask)(Vec3d)) -> Field { return [shape, mask](Vec3d n) { return mask(to_head(shape, n)); }; };
  return {{"lips", in_head(lip_mask)}, {"lashes", in_head(lash_mask)}, {"brows", in_head(brow_mask)}};
}

}  // namespace stokes
