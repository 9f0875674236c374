// Meshes made and moved: isosurfaces are closed, offsets keep their distance, the figures have sensible sizes.
#include <gtest/gtest.h>

#include <numbers>

#include "mesh/field.h"
#include "mesh/generate.h"
#include "mesh/isosurface.h"
#include "mesh/mesh_distance.h"
#include "mesh/offset.h"
#include "mesh/refill.h"
#include "mesh/self_intersection.h"
#include "mesh/shell_measure.h"
#include "mesh/shell_repair.h"

namespace stokes {
namespace {

double volume(const MeshData& m) {
  double v = 0;
  for (const auto& t : m.triangles) v += dot(m.positions[t[0]], cross(m.positions[t[1]], m.positions[t[2]])) / 6;
  return v;
}

MeshData ball(double radius, double step) {
  const Field field = [radius](Vec3d p) { return length(p) - radius; };
  const Vec3d r = Vec3d{1, 1, 1} * (radius + 2 * step);
  return isosurface(sample_field(field, -r, r, step), 0, &field);
}

TEST(Isosurface, BallIsClosedOutwardAndRound) {
  const MeshData m = ball(1, 0.05);
  EXPECT_TRUE(mesh_topology(m).watertight());
  EXPECT_NEAR(volume(m), 4 * std::numbers::pi / 3, 0.01);  // positive: counter-clockwise from outside
  for (const Vec3d& p : m.positions) EXPECT_NEAR(length(p), 1, 1e-3);
  for (std::size_t i = 0; i < m.positions.size(); i++) EXPECT_GT(dot(m.normals[i], normalize(m.positions[i])), 0.999);
}

TEST(Isosurface, EveryCaseOfTheTableIsClosed) {
  // White noise inside a box visits all 256 corner patterns with all their neighbours.
  const Field noise = [](Vec3d p) {
    auto cell = [](double x) { return static_cast<unsigned>(std::floor(x * 20 + 0.5) + 1000); };
    unsigned h = cell(p.x) * 73856093u ^ cell(p.y) * 19349663u ^ cell(p.z) * 83492791u;
    h = (h ^ (h >> 13)) * 2654435761u;
    const double border = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 0.9;
    return border > 0 ? border : (h >> 8) / 16777216.0 - 0.5;
  };
  const MeshData m = isosurface(sample_field(noise, {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}, 0.05, 0, 1e9), 0);
  ASSERT_GT(m.triangles.size(), 10000u);
  const MeshTopology t = mesh_topology(m);
  EXPECT_EQ(t.boundary_edges, 0u);
  EXPECT_EQ(t.nonmanifold_edges, 0u);
}

TEST(MeshTopology, NoticesAMissingFace) {
  MeshData m = ball(1, 0.2);
  m.triangles.pop_back();
  EXPECT_EQ(mesh_topology(m).boundary_edges, 3u);
}

TEST(MeshDistance, SignedDistanceOfABall) {
  const MeshData m = ball(1, 0.05);
  const MeshDistance distance(m);
  for (double r : {0.2, 0.9, 1.5, 3.0}) EXPECT_NEAR(distance(Vec3d{0.6, 0.0, 0.8} * r), r - 1, 2e-3);
}

TEST(Offset, DistanceFieldKeepsTheDistanceAndFlipsNothing) {
  const MeshData m = ball(1, 0.05);
  for (double d : {-0.3, -0.02, 0.2}) {
    const MeshData moved = offset_by_distance_field(m, d);
    EXPECT_TRUE(mesh_topology(moved).watertight());
    const MeshDistance distance(m);
    for (const Vec3d& p : moved.positions) {
      EXPECT_NEAR(distance(p), d, 0.05 * std::abs(d));
      EXPECT_NEAR(length(p), 1 + d, 0.08 * std::abs(d));  // the faceted ball lies up to 3e-4 inside the round one
    }
    for (const auto& t : moved.triangles) {
      const Vec3d n = cross(moved.positions[t[1]] - moved.positions[t[0]], moved.positions[t[2]] - moved.positions[t[0]]);
      EXPECT_GT(dot(n, moved.positions[t[0]]), 0);
    }
  }
}

// What offset.h promises of a shell, measured here anew: every vertex and every face's middle is within 5 % of the distance, and no face looks
// against the way out.
void expect_sound(const MeshData& shell, const MeshDistance& distance, double d) {
  EXPECT_TRUE(mesh_topology(shell).watertight()) << d;
  EXPECT_TRUE(self_intersections(shell).empty()) << d;
  std::size_t flipped = 0, off = 0;
  for (const Vec3d& p : shell.positions) off += std::abs(distance(p) / d - 1) > 0.05;
  for (const auto& t : shell.triangles) {
    const Vec3d a = shell.positions[t[0]], b = shell.positions[t[1]], c = shell.positions[t[2]], middle = (a + b + c) / 3;
    Vec3d nearest;
    const double s = distance(middle, &nearest);
    flipped += !(dot(cross(b - a, c - a), (middle - nearest) * s) > 0);
    off += std::abs(s / d - 1) > 0.05;
  }
  EXPECT_EQ(flipped, 0u) << d;
  EXPECT_EQ(off, 0u) << d;
}

// The head has lids, nostrils and ears: creases of every kind. A shell's flips would be holes for light.
TEST(Offset, ThinShellsOfTheHead) {
  const MeshData head = generate_mesh("head", {4, "", {}});
  const MeshDistance distance(head);
  for (const double d : {-0.06, -0.2, -1.0, 0.5}) {
    const MeshData shell = offset_by_distance_field(head, d);
    EXPECT_LT(shell.triangles.size(), 1.2 * head.triangles.size()) << d;
    expect_sound(shell, distance, d);
  }
}

// The webs between the fingers fold the old connectivity outside, the nails' and the rim's edges inside.
TEST(Offset, ThickShellsOfTheHand) {
  const MeshData hand = generate_mesh("hand", {3, "", {}});
  const MeshDistance distance(hand);
  for (const double d : {-3.0, 2.0}) expect_sound(offset_by_distance_field(hand, d), distance, d);
}

// Masks and uvs are those of the nearest points: where they are linear in space on a plane-faced body, exactly so.
TEST(Offset, MasksAndUvsAreThoseOfTheNearestPoints) {
  MeshData m = ball(1, 0.1);
  m.masks.emplace_back("height", std::vector<float>());
  for (const Vec3d& p : m.positions) {
    m.uvs.push_back({0.3 * p.x + 0.5, 0.2 * p.z - p.y});
    m.masks[0].second.push_back(static_cast<float>(0.4 * p.y + 0.5));
  }
  const MeshDistance distance(m);
  for (const double d : {-0.4, -0.03, 0.3}) {
    const MeshData shell = offset_by_distance_field(m, d);
    ASSERT_EQ(shell.uvs.size(), shell.positions.size()) << d;
    ASSERT_EQ(shell.masks.at(0).second.size(), shell.positions.size()) << d;
    for (std::size_t i = 0; i < shell.positions.size(); i++) {
      Vec3d p;
      distance(shell.positions[i], &p);
      EXPECT_NEAR(shell.uvs[i][0], 0.3 * p.x + 0.5, 1e-9);
      EXPECT_NEAR(shell.uvs[i][1], 0.2 * p.z - p.y, 1e-9);
      EXPECT_NEAR(shell.masks[0].second[i], 0.4 * p.y + 0.5, 1e-6);
    }
  }
}

TEST(SelfIntersection, NoticesAVertexPulledThroughTheOtherSide) {
  MeshData m = ball(1, 0.2);
  EXPECT_TRUE(self_intersections(m).empty());
  m.positions[7] = m.positions[7] * -1.2;
  EXPECT_FALSE(self_intersections(m).empty());
}

TEST(SelfIntersection, NoticesFacesThatShareACorner) {
  // Two triangles with one corner in common, the far side of the second through the first.
  MeshData m;
  m.positions = {{0, 0, 0}, {4, -2, 0}, {4, 2, 0}, {3, 0, -1}, {3, 0, 1}};
  m.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(self_intersections(m).size(), 2u);
  m.positions[3].z = 0.5;
  EXPECT_TRUE(self_intersections(m).empty());
}

TEST(Refill, ClosesAHoleAndRefusesEdgesThatAreTaken) {
  const std::vector<std::array<std::uint32_t, 3>> square = {{0, 1, 2}, {0, 2, 3}};
  const auto weight = [](auto...) { return 1.0; };
  EXPECT_EQ(refill(square, 10, weight, [](auto...) { return true; }).size(), 2u);
  EXPECT_TRUE(refill(square, 10, weight, [](auto...) { return false; }).empty());
  EXPECT_TRUE(refill(square, 3, weight, [](auto...) { return true; }).empty());
}

TEST(ShellRepair, NoticesAndMendsAFlippedFace) {
  const MeshData m = ball(1, 0.1);
  const MeshDistance distance(m);
  MeshData shell = offset_by_distance_field(m, -0.1);
  EXPECT_EQ(shell_faults(shell, distance, -0.1).flipped, 0u);
  shell.positions[7] += normalize(shell.positions[40] - shell.positions[7]) * 0.3;  // far across its neighbours
  EXPECT_GT(shell_faults(shell, distance, -0.1).flipped, 0u);
  const ShellFaults left = repair_shell(shell, distance, -0.1);
  EXPECT_EQ(left.flipped, 0u);
  EXPECT_EQ(left.off_vertices + left.off_faces + left.crossed, 0u);
}

TEST(Offset, AlongNormalsCountsFlippedFaces) {
  std::size_t flipped = 0;
  offset_along_normals(ball(1, 0.1), -0.5, &flipped);
  EXPECT_EQ(flipped, 0u);
  // Past the axis of a rod its side turns inside out. (A ball's faces would not: all three of their directions turn.)
  const Field rod = [](Vec3d p) { return sdf::capsule(p, {0, 0, -1}, {0, 0, 1}, 0.3, 0.3); };
  const MeshData m = isosurface(sample_field(rod, {-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5}, 0.1), 0, &rod);
  offset_along_normals(m, -0.5, &flipped);
  EXPECT_GT(flipped, m.triangles.size() / 2);
}

TEST(Offset, OpenMeshIsRefused) {
  MeshData m = ball(1, 0.2);
  m.triangles.pop_back();
  EXPECT_THROW(offset_by_distance_field(m, -0.1), std::runtime_error);
}

TEST(Generators, HeadAndHandAreClosedAndOfHumanSize) {
  const MeshData head = generate_mesh("head", {4, "", {}});
  EXPECT_TRUE(mesh_topology(head).watertight());
  EXPECT_NEAR(volume(head) / 1e6, 5.2, 0.15);  // litres, shoulders included
  ASSERT_EQ(head.masks.size(), 3u);
  EXPECT_EQ(head.masks[0].second.size(), head.positions.size());
  for (const char* pose : {"open", "relaxed", "cupping", "pointing"}) {
    const MeshData hand = generate_mesh("hand", {3, pose, {}});
    EXPECT_TRUE(mesh_topology(hand).watertight()) << pose;
    EXPECT_NEAR(volume(hand) / 1e3, 345, 20) << pose;  // cm^3
  }
}

// At this step the webs and tips are thinner than a cell: faces that are spread evenly over them pass through one another.
TEST(Generators, ACoarseHandDoesNotCrossItself) {
  for (const double resolution : {6.0, 10.0}) {
    const MeshData hand = generate_mesh("hand", {resolution, "", {}});
    EXPECT_TRUE(mesh_topology(hand).watertight()) << resolution;
    EXPECT_TRUE(self_intersections(hand).empty()) << resolution;
  }
}

TEST(Generators, BadRequestsAreRefused) {
  EXPECT_THROW(generate_mesh("foot", {}), std::invalid_argument);
  EXPECT_THROW(generate_mesh("head", {0.01, "", {}}), std::invalid_argument);
  EXPECT_THROW(generate_mesh("head", {4, "", {{"nose", 3}}}), std::invalid_argument);
  EXPECT_THROW(generate_mesh("hand", {4, "fist", {}}), std::invalid_argument);
}

}  // namespace
}  // namespace stokes
