// From the binary tree to the wide one: which binary nodes become children is decided by least expected cost (Ylitie, Karras and
// Laine 2017, section 3), then nodes and leaf blocks are written in depth-first order.
#include "compiled/bvh.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "compiled/bvh_binary.h"

namespace stokes::compiled {
namespace {

constexpr float kNodeCost = 1.0f;       // a node visit
constexpr float kBlockCost = 1.0f;      // a leaf block
constexpr std::uint32_t kMaxBlocks = 2; // of one leaf (the layout allows 8)
constexpr float kFarAway = 1e30f;       // where the boxes of empty slots are

// cost[i - 1]: the least expected cost of the subtree when it may use up to i slots of the node above it.
struct Costs {
  float cost[7];
};

class Collapse {
 public:
  Collapse(const BinaryTree& tree, const std::vector<layout::Vec3>& positions, const std::vector<layout::Triangle>& triangles, int width)
      : tree_(tree), positions_(positions), triangles_(triangles), width_(width), costs_(std::make_unique_for_overwrite<Costs[]>(tree.places)) {}

  Bvh run() {
    solve(0);
    // Blocks are about two thirds full, nodes about seven children wide.
    const std::size_t blocks = triangles_.size() * 3 / (2 * std::size_t(width_)) + 1;
    bvh_.leaves.reserve(blocks * 10 * std::size_t(width_));
    bvh_.nodes.reserve(blocks * 8 * std::size_t(width_) / std::size_t(width_ - 1));
    const float root_area = tree_.nodes[0].box.area();
    bvh_.sah = root_area > 0 ? costs_[0].cost[0] / root_area : 1;
    write_root();
    return std::move(bvh_);
  }

 private:
  const BinaryNode& node(std::uint32_t i) const { return tree_.nodes[i]; }
  std::uint32_t blocks(std::uint32_t i) const { return (node(i).count + std::uint32_t(width_) - 1) / std::uint32_t(width_); }
  bool may_be_leaf(std::uint32_t i) const { return blocks(i) <= kMaxBlocks; }
  float leaf_cost(std::uint32_t i) const { return kBlockCost * node(i).box.area() * float(blocks(i)); }

  // The least cost of spreading a binary inner node over `slots` slots, and how many the left child gets.
  float distribute(std::uint32_t i, int slots, int* left_slots) const {
    const float *left = costs_[i + 1].cost, *right = costs_[node(i).right].cost;
    float best = std::numeric_limits<float>::infinity();
    for (int k = 1; k < slots; k++) {
      const float cost = left[k - 1] + right[slots - k - 1];
      if (cost < best) best = cost, *left_slots = k;
    }
    return best;
  }

  float inner_cost(std::uint32_t i) const {
    int unused;
    return kNodeCost * node(i).box.area() + distribute(i, width_, &unused);
  }

  void solve(std::uint32_t i) {
    float* cost = costs_[i].cost;
    if (!node(i).right) {
      std::fill_n(cost, 7, leaf_cost(i));
      return;
    }
    solve(i + 1);
    solve(node(i).right);
    cost[0] = inner_cost(i);
    if (may_be_leaf(i)) cost[0] = std::min(cost[0], leaf_cost(i));
    int unused;
    for (int slots = 2; slots < width_; slots++)
      cost[slots - 1] = std::min(cost[slots - 2], distribute(i, slots, &unused));
  }

  bool is_leaf(std::uint32_t i) const { return !node(i).right || (may_be_leaf(i) && leaf_cost(i) <= inner_cost(i)); }

  // The binary nodes that fill up to `slots` slots in place of node i, in the way that `solve` found cheapest.
  void expand(std::uint32_t i, int slots, std::vector<std::uint32_t>& children) const {
    while (slots > 1 && node(i).right && costs_[i].cost[slots - 2] <= costs_[i].cost[slots - 1]) slots--;
    if (slots == 1 || !node(i).right) {
      children.push_back(i);
      return;
    }
    spread(i, slots, children);
  }

  void spread(std::uint32_t i, int slots, std::vector<std::uint32_t>& children) const {
    int left = 1;
    distribute(i, slots, &left);
    expand(i + 1, left, children);
    expand(node(i).right, slots - left, children);
  }

  void write_root() {
    if (is_leaf(0)) {
      const std::uint32_t at = append_node(1);
      write_child(at, 0, 0, write_leaf(0));
    } else {
      write_node(0, 1);
    }
  }

  std::uint32_t write_node(std::uint32_t i, int depth) {
    std::vector<std::uint32_t> children;
    children.reserve(std::size_t(width_));
    spread(i, width_, children);
    const std::uint32_t at = append_node(depth);
    for (std::size_t k = 0; k < children.size(); k++)
      write_child(at, int(k), children[k], is_leaf(children[k]) ? write_leaf(children[k]) : write_node(children[k], depth + 1));
    return at;
  }

  // A node whose slots are all empty.
  std::uint32_t append_node(int depth) {
    const auto w = std::size_t(width_), at = bvh_.nodes.size();
    bvh_.nodes.resize(at + 8 * w, 0.0f);
    std::fill_n(bvh_.nodes.begin() + std::ptrdiff_t(at), 6 * w, kFarAway);
    const std::uint32_t none = STOKES_NONE;
    for (std::size_t k = 0; k < w; k++) std::memcpy(&bvh_.nodes[at + 6 * w + k], &none, 4);
    bvh_.depth = std::max(bvh_.depth, depth);
    return std::uint32_t(at / (8 * w));
  }

  void write_child(std::uint32_t at, int slot, std::uint32_t child, std::uint32_t reference) {
    float* out = &bvh_.nodes[std::size_t(at) * 8 * std::size_t(width_)] + slot;
    const Box4& box = node(child).box;
    for (int a = 0; a < 3; a++) out[2 * a * width_] = box.low[a], out[(2 * a + 1) * width_] = box.high[a];
    std::memcpy(out + 6 * width_, &reference, 4);
  }

  std::uint32_t write_leaf(std::uint32_t i) {
    const auto w = std::size_t(width_);
    const std::size_t first = bvh_.leaves.size() / (10 * w);
    bvh_.leaves.resize(bvh_.leaves.size() + blocks(i) * 10 * w, 0.0f);
    for (std::size_t k = 0; k < blocks(i) * w; k++) {
      float* out = &bvh_.leaves[(first + k / w) * 10 * w + k % w];
      const std::uint32_t id = k < node(i).count ? tree_.primitives[node(i).first + k].id : STOKES_NONE;
      std::memcpy(out + 9 * w, &id, 4);
      if (id == STOKES_NONE) continue;
      const layout::Triangle& t = triangles_[id];
      std::size_t row = 0;
      for (std::uint32_t v : {t.v0, t.v1, t.v2})
        for (float x : {positions_[v].x, positions_[v].y, positions_[v].z}) out[w * row++] = x;
    }
    return STOKES_LEAF_BIT | std::uint32_t(first << 3) | (blocks(i) - 1);
  }

  const BinaryTree& tree_;
  const std::vector<layout::Vec3>& positions_;
  const std::vector<layout::Triangle>& triangles_;
  int width_;
  std::unique_ptr<Costs[]> costs_;
  Bvh bvh_;
};

}  // namespace

Bvh build_bvh(const std::vector<layout::Vec3>& positions, const std::vector<layout::Triangle>& triangles, int width) {
  std::vector<BuildPrimitive> primitives(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); i++) {
    BuildPrimitive& p = primitives[i];
    p.id = i;
    for (std::uint32_t v : {triangles[i].v0, triangles[i].v1, triangles[i].v2})
      p.box.add(Float4{positions[v].x, positions[v].y, positions[v].z, 0});
  }
  const BinaryTree tree = build_binary_tree(std::move(primitives), std::uint32_t(std::max(1, width / 4)));
  return Collapse(tree, positions, triangles, width).run();
}

}  // namespace stokes::compiled
