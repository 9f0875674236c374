// The head's bones and masses: skull, face, jaw, neck, and how the parts are joined. Features are in head_features.cpp.
#include "mesh/head.h"

#include <memory>
#include <numbers>

#include "mesh/head_features.h"

namespace stokes {

using namespace sdf;

namespace {

// The masses, built once: rotations and splines are resampled here and only evaluated afterwards.
struct HeadMasses {
  Rotation temporalis = rotation(0, 16, 4), malar = rotation(0, 28, -14), masseter = rotation(0, 10, 10), buccal = rotation(0, 25, 10);
  Tube arch{{{49, -21, 60, 8}, {58.5, -18, 36, 8}, {61, -15, 6, 8}}, 5};
  Tube mandible{{{6, -99, 80, 10.5}, {21, -96, 69, 10}, {34, -87, 44, 10.5}, {42, -72, 18, 11.5}, {51, -40, 2, 13}}, 10};
  Tube brow_ridge{{{6, 15, 86.5, 6.5}, {20, 17.5, 86.5, 7}, {36, 18, 81, 7}, {49, 12, 68, 7}, {54, 0, 58, 6}}, 8};
  Tube trapezius{{{18, -50, -34, 14}, {23, -105, -35, 16}, {42, -200, -46, 22}}, 5};
  Rotation orbit = rotation(0, 16, -6);

  double cranium(Vec3d p) const {
    const Vec3d m{std::sqrt(p.x * p.x + 81), p.y, p.z};  // a wide smooth |x|: no seam on the forehead
    double d = ellipsoid(p, {0, 32, -4}, {73.5, 79, 93});                               // brain case
    d = smooth_min(d, ellipsoid(p, {0, 30, 32}, {60, 54, 60}), 26);                     // frontal bone
    d = smooth_min(d, ellipsoid(p, {0, 14, -42}, {60, 56, 50}), 28);                    // occiput
    d = smooth_min(d, ellipsoid(m, {22, 42, 60}, {26, 24, 26}), 26);                    // frontal eminences
    return smooth_min(d, ellipsoid(m, {52, 12, 38}, {14, 32, 30}, temporalis), 24);
  }
  double face(Vec3d p, Vec3d m) const {
    double d = ellipsoid(p, {0, -22, 32}, {60, 74, 56});
    d = smooth_min(d, ellipsoid(p, {0, -64, 62}, {34, 33, 38.5}), 20);                  // maxilla
    return smooth_min(d, ellipsoid(m, {31, -36, 62}, {26, 28, 24}), 18);                // cheek fat
  }
  double zygoma(Vec3d m) const { return smooth_min(ellipsoid(m, {47, -21, 64}, {15, 10, 18}, malar), arch(m), 18); }
  double jaw(Vec3d p) const {
    const Vec3d m{std::sqrt(p.x * p.x + 36), p.y, p.z};
    double d = mandible(m);
    d = smooth_min(d, ellipsoid(m, {43, -45, 27}, {18, 34, 30}, masseter), 18);
    d = smooth_min(d, ellipsoid(m, {34, -60, 52}, {16, 26, 22}, buccal), 16);
    d = smooth_min(d, ellipsoid(p, {0, -99, 79.5}, {19, 13.5, 15}), 14);                // chin
    return smooth_min(d, ellipsoid(p, {0, -90, 42}, {32, 15, 44}), 16);                 // floor of the mouth
  }
  double brow(Vec3d p, Vec3d m) const { return smooth_min(brow_ridge(m), ellipsoid(p, {0, 15, 84}, {16, 10, 10}), 10); }
};

double neck(const HeadMasses& masses, const Tube& sternomastoid, Vec3d n, Vec3d nm) {
  double d = smooth_min(ellipsoid(n, {0, -120, -8}, {46, 120, 44}), capsule(n, {0, -60, -6}, {0, -210, -20}, 40, 51), 20);
  d = smooth_min(d, sternomastoid(nm), 22);
  d = smooth_min(d, ellipsoid(n, {0, -140, 24}, {12, 22, 15}), 18);  // larynx
  return smooth_min(d, masses.trapezius(nm), 20);
}

constexpr Vec3d kPivot{0, -40, -8};
constexpr Vec3d kMastoid{57, -34, -14};

// From the neck's frame, which is the world's, to the tilted head's.
Vec3d to_head(const HeadShape& shape, Vec3d n) {
  const double t = shape.pitch * std::numbers::pi / 180, c = std::cos(t), s = std::sin(t);
  const double dy = n.y - kPivot.y, dz = n.z - kPivot.z;
  return {n.x + shape.asymmetry * std::sin(n.y * 0.035 + 0.6), kPivot.y + c * dy - s * dz, kPivot.z + s * dy + c * dz};
}

}  // namespace

Field head_field(const HeadShape& shape) {
  const double t = shape.pitch * std::numbers::pi / 180, c = std::cos(t), s = std::sin(t);
  const double my = kMastoid.y - kPivot.y, mz = kMastoid.z - kPivot.z;
  const TubePoint mastoid{kMastoid.x, kPivot.y + c * my + s * mz, kPivot.z - s * my + c * mz, 9};
  const auto masses = std::make_shared<const HeadMasses>();
  const auto features = std::make_shared<const HeadFeatures>();
  const Tube sternomastoid({mastoid, {43, -96, 12, 9}, {28, -145, 26, 8}, {12, -205, 33, 7}}, 8);
  return [shape, masses, features, sternomastoid](Vec3d n) {
    const Vec3d p = to_head(shape, n);
    const Vec3d m{std::sqrt(p.x * p.x + 1), p.y, p.z};  // a smooth |x|: no crease on the midline
    double d = masses->cranium(p);
    d = smooth_min(d, masses->face(p, m), 24);
    d = smooth_min(d, masses->jaw(p), 16);
    d = smooth_min(d, masses->zygoma(m), 20);
    d = smooth_min(d, masses->brow(p, m), 17);
    d = carve(d, ellipsoid(m, {34, -3, 97.5}, {20.5, 13, 19}, masses->orbit), 10);
    d = features->nose(d, p, m);
    d = features->lips(d, p, m);
    d = features->eyes(d, m);
    d = smooth_min(d, neck(*masses, sternomastoid, n, {m.x, n.y, n.z}), 16);
    d = smooth_min(d, features->ear(m), 3.5);
    return smooth_max(d, shape.cut_y - n.y, 1.5);
  };
}

void head_bounds(const HeadShape& shape, Vec3d& lo, Vec3d& hi) {
  const double e = std::abs(shape.pitch) * 1.2;
  lo = {-92, shape.cut_y - 4, -104 - e};
  hi = {92, 118, 122 + 0.5 * e};
}

std::vector<std::pair<std::string, Field>> head_masks(const HeadShape& shape) {
  auto in_head = [shape](double (*mask)(Vec3d)) -> Field { return [shape, mask](Vec3d n) { return mask(to_head(shape, n)); }; };
  return {{"lips", in_head(lip_mask)}, {"lashes", in_head(lash_mask)}, {"brows", in_head(brow_mask)}};
}

}  // namespace stokes
