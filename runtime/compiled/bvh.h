// The bounding volume hierarchy over a scene's triangles, in the layout's nodes and leaf blocks. Knows triangles and nothing
// else of a scene.
#pragma once
#include <cstdint>
#include <vector>

#include "layout.h"

namespace stokes::compiled {

struct Bvh {
  std::vector<float> nodes;   ///< width * 8 words a node; node 0 is the root
  std::vector<float> leaves;  ///< width * 10 words a block
  int depth = 0;              ///< nodes on the longest way down
  double sah = 0;             ///< expected node visits plus leaf blocks tested by a ray that hits the root's box
};

/// Builds a tree of `width` (8, 4 or 2) children a node: a binary tree by the surface area heuristic, collapsed to the wide tree
/// of least cost. There must be at least one triangle.
Bvh build_bvh(const std::vector<layout::Vec3>& positions, const std::vector<layout::Triangle>& triangles, int width);

}  // namespace stokes::compiled
