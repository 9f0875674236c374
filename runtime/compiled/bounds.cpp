// See bounds.h.
#include "compiled/bounds.h"

#include <cmath>

#include "compiled/shapes.h"

namespace stokes::compiled {

Bounds scene_bounds(const CompiledScene& scene) {
  Bounds box;
  for (const layout::Quad& q : scene.quads) {
    const Vec3d p = to_double(q.corner), u = to_double(q.edge_u), v = to_double(q.edge_v);
    for (Vec3d corner : {p, p + u, p + v, p + u + v}) box.add(corner);
  }
  for (const layout::Sphere& s : scene.spheres) {
    const double r = s.radius;
    box.add(to_double(s.center) - Vec3d{r, r, r});
    box.add(to_double(s.center) + Vec3d{r, r, r});
  }
  for (const layout::Ellipsoid& e : scene.ellipsoids) {
    // The unit sphere's image reaches as far along an axis as the matrix's row is long.
    double center[3], reach[3];
    for (int i = 0; i < 3; i++) {
      const float* row = e.to_world + 4 * i;
      center[i] = row[3];
      reach[i] = std::hypot(double(row[0]), double(row[1]), double(row[2]));
    }
    box.add({center[0] - reach[0], center[1] - reach[1], center[2] - reach[2]});
    box.add({center[0] + reach[0], center[1] + reach[1], center[2] + reach[2]});
  }
  for (const layout::Vec3& p : scene.positions) box.add(to_double(p));
  return box;
}

}  // namespace stokes::compiled
