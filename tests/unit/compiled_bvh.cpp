// The tree over the triangles: every triangle once, boxes that contain, and the same hits as testing all of them.
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <set>

#include "compiled/bvh.h"
#include "compiled/first_hit.h"
#include "compiled/shapes.h"
#include "compiled_scenes.h"

namespace stokes::test {

MeshData bumpy_sphere(int n) {
  MeshData m;
  for (int i = 0; i <= n; i++)
    for (int j = 0; j < n; j++) {
      const double theta = std::numbers::pi * i / n, phi = 2 * std::numbers::pi * j / n;
      const double r = 1 + 0.1 * std::sin(7 * theta) * std::cos(9 * phi) + 0.03 * std::cos(31 * theta + phi);
      m.positions.push_back({r * std::sin(theta) * std::cos(phi), r * std::cos(theta), r * std::sin(theta) * std::sin(phi)});
    }
  const auto at = [n](int i, int j) { return std::uint32_t(i * n + j % n); };
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      m.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      m.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  return m;
}

namespace {

using compiled::to_double;

std::uint32_t word(const std::vector<float>& v, std::size_t i) {
  std::uint32_t w;
  std::memcpy(&w, &v.at(i), 4);
  return w;
}

// Walks the whole tree and checks what a traversal relies on.
struct Checker {
  explicit Checker(const CompiledScene& scene) : s(scene) {}

  const CompiledScene& s;
  std::size_t w = std::size_t(s.bvh_width);
  std::vector<int> seen = std::vector<int>(s.triangles.size(), 0);
  std::set<std::uint32_t> visited;
  std::size_t slots = 0, used = 0;

  struct Box {
    double low[3], high[3];
  };

  void leaf(std::uint32_t reference, const Box& box) {
    const std::size_t first = (reference & ~STOKES_LEAF_BIT) >> 3, blocks = (reference & 7) + 1;
    for (std::size_t k = 0; k < blocks * w; k++) {
      const std::size_t at = (first + k / w) * 10 * w + k % w;
      const std::uint32_t id = word(s.bvh_leaves, at + 9 * w);
      slots++;
      if (id == STOKES_NONE) {
        for (std::size_t row = 0; row < 9; row++) EXPECT_EQ(s.bvh_leaves.at(at + row * w), 0.0f);
        continue;
      }
      ASSERT_LT(id, seen.size());
      seen[id]++;
      used++;
      const layout::Triangle& t = s.triangles[id];
      std::size_t row = 0;
      for (std::uint32_t v : {t.v0, t.v1, t.v2})
        for (int a = 0; a < 3; a++, row++) {
          const float x = s.bvh_leaves.at(at + row * w);
          EXPECT_EQ(x, a == 0 ? s.positions[v].x : a == 1 ? s.positions[v].y : s.positions[v].z);
          EXPECT_GE(x, box.low[a]);
          EXPECT_LE(x, box.high[a]);
        }
    }
  }

  void node(std::uint32_t index, const Box& outer) {
    ASSERT_TRUE(visited.insert(index).second) << "node " << index << " has two parents";
    const std::size_t at = index * 8 * w;
    for (std::size_t k = 0; k < w; k++) {
      const std::uint32_t child = word(s.bvh_nodes, at + 6 * w + k);
      Box box;
      for (std::size_t a = 0; a < 3; a++) box.low[a] = s.bvh_nodes[at + 2 * a * w + k], box.high[a] = s.bvh_nodes[at + (2 * a + 1) * w + k];
      for (std::size_t a = 0; a < 3; a++) {
        ASSERT_LE(box.low[a], box.high[a]) << "inverted box";
        if (child == STOKES_NONE) {
          EXPECT_GE(box.low[a], 1e29);
          continue;
        }
        EXPECT_GE(box.low[a], outer.low[a]);
        EXPECT_LE(box.high[a], outer.high[a]);
      }
      if (child == STOKES_NONE) continue;
      child & STOKES_LEAF_BIT ? leaf(child, box) : node(child, box);
    }
  }

  void run() {
    node(0, {{-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}});
    for (std::size_t i = 0; i < seen.size(); i++) EXPECT_EQ(seen[i], 1) << "triangle " << i;
    EXPECT_EQ(visited.size(), s.bvh_nodes.size() / (8 * w));
    EXPECT_EQ(slots, s.bvh_leaves.size() / 10);
  }
};

// A traversal in double precision with the layout's meaning of nodes and leaves.
std::uint32_t traverse(const CompiledScene& s, Vec3d o, Vec3d d, double& nearest) {
  const auto w = std::size_t(s.bvh_width);
  std::vector<std::uint32_t> stack{0};
  std::uint32_t best = STOKES_NONE;
  while (!stack.empty()) {
    const std::uint32_t reference = stack.back();
    stack.pop_back();
    if (reference & STOKES_LEAF_BIT) {
      const std::size_t first = (reference & ~STOKES_LEAF_BIT) >> 3, blocks = (reference & 7) + 1;
      for (std::size_t k = 0; k < blocks * w; k++) {
        const std::size_t at = (first + k / w) * 10 * w + k % w;
        const std::uint32_t id = word(s.bvh_leaves, at + 9 * w);
        if (id == STOKES_NONE) continue;
        const auto vertex = [&](std::size_t v) {
          return Vec3d{s.bvh_leaves[at + (3 * v) * w], s.bvh_leaves[at + (3 * v + 1) * w], s.bvh_leaves[at + (3 * v + 2) * w]};
        };
        const Vec3d p0 = vertex(0), e1 = vertex(1) - p0, e2 = vertex(2) - p0, p = cross(d, e2), q = cross(o - p0, e1);
        const double det = dot(e1, p), u = dot(o - p0, p) / det, v = dot(d, q) / det, t = dot(e2, q) / det;
        if (det != 0 && u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) nearest = t, best = id;
      }
      continue;
    }
    for (std::size_t k = 0; k < w; k++) {
      const std::size_t at = reference * 8 * w;
      const std::uint32_t child = word(s.bvh_nodes, at + 6 * w + k);
      if (child == STOKES_NONE) continue;
      double t0 = 0, t1 = nearest;
      for (std::size_t a = 0; a < 3; a++) {
        const double low = s.bvh_nodes[at + 2 * a * w + k], high = s.bvh_nodes[at + (2 * a + 1) * w + k];
        const double ta = (low - o[int(a)]) / d[int(a)], tb = (high - o[int(a)]) / d[int(a)];
        t0 = std::max(t0, std::min(ta, tb) * (1 - 1e-12)), t1 = std::min(t1, std::max(ta, tb) * (1 + 1e-12));
      }
      if (t0 <= t1) stack.push_back(child);
    }
  }
  return best;
}

class CompiledBvh : public testing::TestWithParam<int> {
 protected:
  CompiledScene compile(MeshData m) const {
    CompileOptions options;
    options.bvh_width = GetParam();
    return compile_scene(scene_of({mesh(lambertian(), std::move(m))}), options);
  }
};
INSTANTIATE_TEST_SUITE_P(Widths, CompiledBvh, testing::Values(2, 4, 8));

TEST_P(CompiledBvh, HoldsEveryTriangleOnceInsideItsBoxes) {
  const CompiledScene s = compile(bumpy_sphere(40));
  Checker checker(s);
  checker.run();
  EXPECT_GT(double(checker.used) / double(checker.slots), 0.5) << "leaf blocks are mostly empty";
}

TEST_P(CompiledBvh, FindsWhatTestingEveryTriangleFinds) {
  const CompiledScene s = compile(bumpy_sphere(24));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.2, 1.2);
  int hits = 0;
  for (int i = 0; i < 2000; i++) {
    const Vec3d o{uniform(random), uniform(random), uniform(random)}, d{uniform(random), uniform(random), uniform(random)};
    const auto expected = compiled::first_hit(s, o, d);
    double t = INFINITY;
    const std::uint32_t found = traverse(s, o, d, t);
    ASSERT_EQ(found != STOKES_NONE, expected.has_value()) << i;
    if (!expected) continue;
    hits++;
    EXPECT_EQ(t, expected->t);
  }
  EXPECT_GT(hits, 500);
}

TEST_P(CompiledBvh, TakesOneTriangleAndManyEqualOnes) {
  const CompiledScene one = compile(one_triangle());
  Checker(one).run();
  MeshData m = one_triangle();
  m.triangles.assign(1000, m.triangles[0]);
  const CompiledScene many = compile(m);
  Checker(many).run();
}

// Triangles whose sizes and distances fall geometrically make a deep tree for any greedy split; its depth must stay bounded.
TEST_P(CompiledBvh, StaysShallowOnGeometricSequences) {
  std::vector<layout::Vec3> positions;
  std::vector<layout::Triangle> triangles;
  for (int i = 0; i < 2000; i++) {
    const float x = std::pow(0.98f, float(i)) * 1e6f;
    const auto v = layout::uint(positions.size());
    positions.insert(positions.end(), {{x, 0, 0}, {x * 1.001f, 0, 0}, {x, x * 0.001f, 0}});
    triangles.push_back({v, v + 1, v + 2, 0, 0, 1, 0, 0});
  }
  const compiled::Bvh bvh = compiled::build_bvh(positions, triangles, GetParam());
  EXPECT_LE(bvh.depth, 72);
}

// The expected work of a ray: 11.5 node visits and leaf blocks. Median splits in place of the heuristic make it 13.4.
TEST(CompiledBvhQuality, IsWhatTheHeuristicReaches) {
  const CompiledScene s = compile_scene(scene_of({mesh(lambertian(), bumpy_sphere(100))}));
  const compiled::Bvh bvh = compiled::build_bvh(s.positions, s.triangles, 8);
  EXPECT_LT(bvh.sah, 12);
  EXPECT_GT(bvh.sah, 8);
}

}  // namespace
}  // namespace stokes::test
