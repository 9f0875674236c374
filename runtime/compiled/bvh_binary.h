// The binary tree that a wide one is collapsed from. Knows boxes, not triangles.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace stokes::compiled {

/// Four floats that the compiler keeps in one register; the fourth is carried along unused.
typedef float Float4 __attribute__((vector_size(16)));
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

struct Box4 {
  static constexpr float kInf = std::numeric_limits<float>::infinity();
  Float4 low{kInf, kInf, kInf, kInf}, high{-kInf, -kInf, -kInf, -kInf};

  void add(Float4 p) { low = min4(low, p), high = max4(high, p); }
  void add(const Box4& b) { low = min4(low, b.low), high = max4(high, b.high); }
  /// Half the surface area; 0 for the empty box.
  float area() const {
    const Float4 d = high - low;
    return d[0] >= 0 ? d[0] * d[1] + d[1] * d[2] + d[2] * d[0] : 0.0f;
  }
};

/// A primitive while the tree is built.
struct BuildPrimitive {
  Box4 box;
  std::uint32_t id;
};

struct BinaryNode {
  Box4 box;
  std::uint32_t first, count;  ///< its primitives, contiguous after the build
  std::uint32_t right;         ///< the right child; the left one is the next node. 0: a leaf
};

struct BinaryTree {
  std::unique_ptr<BinaryNode[]> nodes;  ///< with gaps, never written: a subtree over n primitives owns 2 n - 1 places
  std::size_t places = 0;               ///< of `nodes`
  std::vector<BuildPrimitive> primitives;
};

/// Top-down by the surface area heuristic: binned for many primitives, a full sweep for few, until at most `leaf_size` are left.
BinaryTree build_binary_tree(std::vector<BuildPrimitive> primitives, std::uint32_t leaf_size);

}  // namespace stokes::compiled
