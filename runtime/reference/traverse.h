// The first primitive along a ray. Embree 3 (robust mode) walks its own BVH over the primitives' boxes; every primitive inside is
// tested by intersect.h in double. Knows nothing of materials.
#pragma once
#include <memory>

#include "reference/intersect.h"

namespace stokes::reference {

class Traversal {
 public:
  /// Builds the BVH over all primitives. Throws std::runtime_error with Embree's message when that fails. Keeps a reference to the scene.
  explicit Traversal(const CompiledScene& scene);
  ~Traversal();
  Traversal(const Traversal&) = delete;
  Traversal& operator=(const Traversal&) = delete;

  /// The nearest hit with t < t_max. `skip` is a primitive that is looked through.
  Hit closest_hit(const Ray& ray, double t_max = kInfinity, std::uint32_t skip = STOKES_NONE) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stokes::reference
