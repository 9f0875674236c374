// The top-down build. See bvh_binary.h.
#include "compiled/bvh_binary.h"

#include <algorithm>
#include <array>
#include <future>
#include <thread>

namespace stokes::compiled {
namespace {

constexpr int kMaxBins = 32;
constexpr std::uint32_t kSweepBelow = 12;       // primitives: below this every split is tried
constexpr std::uint32_t kTaskAbove = 1u << 15;  // primitives: above this a subtree may become a task
constexpr int kMaxDepth = 60;                   // below it only halves, so that traversal stacks stay bounded

using Iterator = BuildPrimitive*;

// Twice the centroid.
Float4 centroid(const BuildPrimitive& p) { return p.box.low + p.box.high; }

struct Split {
  float cost = std::numeric_limits<float>::infinity();
  int axis = -1;
  int bin = 0;             // binned: the first bin of the right side
  std::uint32_t left = 0;  // swept: how many go left, in the order of the axis
};

// Maps centroids to bins along each axis.
struct BinMap {
  Float4 low, scale;
  int bins;
  // Few primitives need few bins: clearing and sweeping them costs as much as filling them.
  BinMap(const Box4& centroids, std::ptrdiff_t count) : low(centroids.low), bins(int(std::min<std::ptrdiff_t>(kMaxBins, 8 + count / 8))) {
    const Float4 extent = centroids.high - centroids.low;
    for (int a = 0; a < 4; a++) scale[a] = extent[a] > 0 ? float(bins) * 0.99999f / extent[a] : 0.0f;
  }
  int bin(Float4 c, int axis) const { return std::clamp(int((c[axis] - low[axis]) * scale[axis]), 0, bins - 1); }
};

Split best_bins(const Box4* boxes, const std::uint32_t* counts, int bins, int axis, Split best) {
  std::array<float, kMaxBins> right_cost;
  Box4 box;
  std::uint32_t count = 0;
  for (int b = bins - 1; b > 0; b--) {
    box.add(boxes[b]);
    count += counts[b];
    right_cost[b] = count ? box.area() * float(count) : -1.0f;
  }
  box = Box4{};
  count = 0;
  for (int b = 1; b < bins; b++) {
    box.add(boxes[b - 1]);
    count += counts[b - 1];
    if (!count || right_cost[b] < 0) continue;
    const float cost = box.area() * float(count) + right_cost[b];
    if (cost < best.cost) best = {cost, axis, b, 0};
  }
  return best;
}

Split find_binned(Iterator first, Iterator last, const BinMap& map) {
  Box4 boxes[3][kMaxBins];
  std::uint32_t counts[3][kMaxBins] = {};
  for (Iterator p = first; p != last; ++p) {
    const Float4 c = (centroid(*p) - map.low) * map.scale;
    for (int a = 0; a < 3; a++) {
      const int b = std::clamp(int(c[a]), 0, map.bins - 1);
      boxes[a][b].add(p->box);
      counts[a][b]++;
    }
  }
  Split best;
  for (int a = 0; a < 3; a++)
    if (map.scale[a] > 0) best = best_bins(boxes[a], counts[a], map.bins, a, best);
  return best;
}

void sort_along(Iterator first, Iterator last, int axis) {
  std::sort(first, last, [axis](const BuildPrimitive& a, const BuildPrimitive& b) {
    const float ca = centroid(a)[axis], cb = centroid(b)[axis];
    return ca != cb ? ca < cb : a.id < b.id;
  });
}

Split find_swept(Iterator first, Iterator last) {
  const auto n = std::uint32_t(last - first);
  std::array<float, kSweepBelow> right_cost;
  Split best;
  for (int axis = 0; axis < 3; axis++) {
    sort_along(first, last, axis);
    Box4 box;
    for (std::uint32_t i = n - 1; i > 0; i--) {
      box.add(first[i].box);
      right_cost[i] = box.area() * float(n - i);
    }
    box = Box4{};
    for (std::uint32_t i = 1; i < n; i++) {
      box.add(first[i - 1].box);
      const float cost = box.area() * float(i) + right_cost[i];
      if (cost < best.cost) best = {cost, axis, 0, i};
    }
  }
  return best;
}

// Halves along the longest axis, for what the heuristic cannot tell apart.
Iterator split_median(Iterator first, Iterator last, const Box4& centroids) {
  const Float4 extent = centroids.high - centroids.low;
  const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
  Iterator middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [axis](const BuildPrimitive& a, const BuildPrimitive& b) {
    const float ca = centroid(a)[axis], cb = centroid(b)[axis];
    return ca != cb ? ca < cb : a.id < b.id;
  });
  return middle;
}

class Builder {
 public:
  Builder(BinaryTree& tree, std::uint32_t leaf_size) : tree_(tree), leaf_size_(leaf_size) {}

  // Builds the subtree of primitives [first, first + count) at `node`, which owns the places [node, node + 2 count - 1).
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth, int tasks) {
    const Iterator begin = tree_.primitives.data() + first, end = begin + count;
    Box4 box, centroids;
    for (Iterator p = begin; p != end; ++p) box.add(p->box), centroids.add(centroid(*p));
    BinaryNode& n = tree_.nodes[node];
    n = {box, first, count, 0};
    if (count <= leaf_size_) return;

    const auto left = std::uint32_t(partition(begin, end, centroids, depth) - begin);
    n.right = node + 2 * left;
    if (count > kTaskAbove && tasks > 1) {
      const auto task = std::async(std::launch::async, [&] { build(node + 1, first, left, depth + 1, tasks / 2); });
      build(n.right, first + left, count - left, depth + 1, tasks - tasks / 2);
      task.wait();
    } else {
      build(node + 1, first, left, depth + 1, 1);
      build(n.right, first + left, count - left, depth + 1, 1);
    }
  }

 private:
  Iterator partition(Iterator begin, Iterator end, const Box4& centroids, int depth) const {
    if (depth >= kMaxDepth) return split_median(begin, end, centroids);
    if (end - begin < std::ptrdiff_t(kSweepBelow)) {
      const Split s = find_swept(begin, end);
      if (s.axis < 0) return split_median(begin, end, centroids);
      if (s.axis != 2) sort_along(begin, end, s.axis);  // the sweep leaves them sorted along z
      return begin + s.left;
    }
    const BinMap map(centroids, end - begin);
    const Split s = find_binned(begin, end, map);
    if (s.axis < 0) return split_median(begin, end, centroids);
    return std::partition(begin, end, [&](const BuildPrimitive& p) { return map.bin(centroid(p), s.axis) < s.bin; });
  }

  BinaryTree& tree_;
  std::uint32_t leaf_size_;
};

}  // namespace

BinaryTree build_binary_tree(std::vector<BuildPrimitive> primitives, std::uint32_t leaf_size) {
  BinaryTree tree;
  tree.primitives = std::move(primitives);
  const auto count = std::uint32_t(tree.primitives.size());
  tree.places = 2 * std::size_t(count);
  tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(tree.places);
  // More tasks than cores, because the heuristic's halves are uneven.
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  Builder(tree, leaf_size).build(0, 0, count, 0, cores > 1 ? 4 * cores : 1);
  return tree;
}

}  // namespace stokes::compiled
