// The exact signed distance to a closed triangle mesh.
#pragma once
#include <memory>

#include "mesh/mesh.h"

namespace stokes {

class MeshDistance {
 public:
  explicit MeshDistance(const MeshData& mesh);
  ~MeshDistance();
  /// The nearest point of the mesh, and the distance to it, negative inside (by the angle-weighted pseudo-normal of the nearest
  /// feature, Baerentzen & Aanaes 2005).
  double operator()(Vec3d p, Vec3d* nearest = nullptr) const;

  struct State;

 private:
  std::unique_ptr<State> state_;
};

}  // namespace stokes
