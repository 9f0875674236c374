// Normals of meshes that bring none. Knows nothing of scenes.
#include <algorithm>
#include <cmath>

#include "import/affine_json.h"

namespace stokes {

void give_smooth_normals(ImportedMesh& mesh, const Affine& to_world) {
  const auto at = [&](int i) {
    const auto& p = mesh.positions[static_cast<std::size_t>(i)];
    return to_world.vector({p[0], p[1], p[2]});
  };
  std::vector<Vec3d> sums(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vec3d corners[3] = {at(t[0]), at(t[1]), at(t[2])};
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(length(normal) > 0)) continue;
    for (std::size_t k = 0; k < 3; k++) {
      const Vec3d one = normalize(corners[(k + 1) % 3] - corners[k]), other = normalize(corners[(k + 2) % 3] - corners[k]);
      const double angle = std::acos(std::clamp(dot(one, other), -1.0, 1.0));
      sums[static_cast<std::size_t>(t[k])] = sums[static_cast<std::size_t>(t[k])] + normalize(normal) * angle;
    }
  }
  // Back to the mesh's frame, where its winding says what is outside.
  const double side = to_world.determinant() < 0 ? -1 : 1;
  mesh.normals.clear();
  for (const Vec3d& sum : sums) {
    const Vec3d local{dot(to_world.column(0), sum), dot(to_world.column(1), sum), dot(to_world.column(2), sum)};
    const Vec3d n = length(local) > 0 ? normalize(local) * side : Vec3d{0, 0, 1};
    mesh.normals.push_back({n.x, n.y, n.z});
  }
}

}  // namespace stokes
