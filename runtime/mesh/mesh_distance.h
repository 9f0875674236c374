// The exact signed distance to a closed triangle mesh.
#pragma once
#include <memory>

#include "mesh/mesh.h"

namespace stokes {

/// A point of a mesh: a triangle, and the weights of its corners, which sum to 1.
struct MeshPoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights = {1, 0, 0};
};

class MeshDistance {
 public:
  explicit MeshDistance(const MeshData& mesh);
  ~MeshDistance();
  /// The nearest point of the mesh, and the distance to it, negative inside (by the angle-weighted pseudo-normal of the nearest
  /// feature, Baerentzen & Aanaes 2005), and the triangle that the nearest point lies on. `expected`: the answer is found sooner where
  /// the mesh is no further away than this.
  double operator()(Vec3d p, Vec3d* nearest = nullptr, std::uint32_t* triangle = nullptr, double expected = 1e30) const;

  /// The point of the mesh that is nearest to p.
  MeshPoint nearest(Vec3d p) const;
  /// The weights of a triangle's corners at the foot of p on its plane; outside of the triangle some are negative.
  std::array<double, 3> weights(std::uint32_t triangle, Vec3d p) const;

  struct State;

 private:
  std::unique_ptr<State> state_;
};

}  // namespace stokes
