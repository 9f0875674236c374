// Triangles: the kernels' rays against brute force in double precision and against Embree, and that nothing leaks through closed
// meshes or hits the surface it left.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <cstring>

#include "support/kernel_program.h"
#include "support/test_meshes.h"

namespace stokes::testing {
namespace {

const std::vector<std::string> kTrianglesOnly = {"SPHERES", "ELLIPSOIDS", "QUADS", "TEXTURES", "SMOOTH_NORMALS"};

struct Variant {
  int lanes, width;
  bool x86;
};
void PrintTo(const Variant& v, std::ostream* os) { *os << v.lanes << " lanes, width " << v.width << (v.x86 ? ", x86" : ""); }

struct Hits {
  std::vector<std::int32_t> primitive;
  std::vector<float> tuv;
};

Hits closest(KernelProgram& program, const std::vector<Ray>& rays) {
  Hits h{std::vector<std::int32_t>(rays.size()), std::vector<float>(rays.size() * 3)};
  program.run_with_scene("probe_closest", rays.size() / std::size_t(program.lanes()), ray_floats(rays), Out{h.primitive}, Out{h.tuv});
  return h;
}

KernelProgram program_for(const Variant& v, const Mesh& mesh, std::vector<std::string> without = kTrianglesOnly) {
  KernelVariant k;
  k.lanes = v.lanes;
  k.bvh_width = v.width;
  k.x86 = v.x86;
  k.without = std::move(without);
  KernelProgram program("tests/differential/probes.cl", k);
  program.set_scene(mesh_scene(mesh, v.width));
  return program;
}

std::vector<Ray> random_rays(std::size_t n, unsigned seed, double box) {
  std::mt19937 g(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Ray> rays;
  while (rays.size() < n) {
    const double d[3] = {u(g), u(g), u(g)};
    const double l = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (l > 1 || l < 1e-4) continue;
    Ray r = make_ray(box * u(g), box * u(g), box * u(g), d[0], d[1], d[2]);
    // Some rays run exactly along an axis or in a coordinate plane.
    if (rays.size() % 16 == 0) r = make_ray(r.o[0], r.o[1], r.o[2], 0, d[1], d[2]);
    if (rays.size() % 16 == 1) r = make_ray(r.o[0], r.o[1], r.o[2], 0, 0, d[2]);
    if (rays.size() % 16 == 2) r = make_ray(0, 0, r.o[2], -0.0, 0, 1);
    rays.push_back(r);
  }
  return rays;
}

struct Exact {
  double t = 1e300, margin = 0;
  int index = -1;
};

/// Moeller-Trumbore in double over all triangles; margin is how far inside the nearest hit lies, in barycentric units.
Exact brute_force(const Mesh& m, const Ray& r) {
  Exact best;
  for (std::size_t i = 0; i < m.triangles.size(); i++) {
    const auto& t = m.triangles[i];
    const layout::Vec3 a = m.positions[t.v0], b = m.positions[t.v1], c = m.positions[t.v2];
    const double e1[3] = {double(b.x) - a.x, double(b.y) - a.y, double(b.z) - a.z}, e2[3] = {double(c.x) - a.x, double(c.y) - a.y, double(c.z) - a.z};
    const double p[3] = {r.d[1] * e2[2] - r.d[2] * e2[1], r.d[2] * e2[0] - r.d[0] * e2[2], r.d[0] * e2[1] - r.d[1] * e2[0]};
    const double det = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
    if (det == 0) continue;
    const double s[3] = {double(r.o[0]) - a.x, double(r.o[1]) - a.y, double(r.o[2]) - a.z};
    const double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det;
    const double q[3] = {s[1] * e1[2] - s[2] * e1[1], s[2] * e1[0] - s[0] * e1[2], s[0] * e1[1] - s[1] * e1[0]};
    const double v = (r.d[0] * q[0] + r.d[1] * q[1] + r.d[2] * q[2]) / det;
    const double distance = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / det;
    const double margin = std::min({u, v, 1 - u - v});
    if (margin < 0 || distance <= 0 || distance >= best.t || distance >= r.tmax) continue;
    best = {distance, margin, int(i)};
  }
  return best;
}

class Traverse : public ::testing::TestWithParam<Variant> {};

TEST_P(Traverse, AgreesWithBruteForceInDouble) {
  Mesh mesh = soup_mesh(1500, 3);
  append(mesh, sphere_mesh(12, 24, {0.2f, 0.1f, -0.3f}, 0.5));
  KernelProgram program = program_for(GetParam(), mesh);
  const std::vector<Ray> rays = random_rays(4096, 5, 1.5);
  const Hits h = closest(program, rays);
  int different = 0, hits = 0;
  for (std::size_t i = 0; i < rays.size(); i++) {
    const Exact e = brute_force(mesh, rays[i]);
    hits += e.index >= 0;
    if (h.primitive[i] != e.index) {
      // Only a ray within rounding of an edge may choose differently, or two surfaces at equal distance.
      different++;
      const bool near_tie = h.primitive[i] >= 0 && std::abs(h.tuv[3 * i] - e.t) < 1e-5;
      EXPECT_TRUE(near_tie || (e.index >= 0 && e.margin < 1e-4) || h.primitive[i] >= 0) << "ray " << i;
      continue;
    }
    if (e.index >= 0) {
      EXPECT_NEAR(h.tuv[3 * i], e.t, 2e-6 * (1 + e.t)) << "ray " << i;
    }
  }
  EXPECT_LE(different, 4);
  EXPECT_GT(hits, 1000);
}

TEST_P(Traverse, OccludedMeansThatSomethingLiesBeforeTmax) {
  const Mesh mesh = soup_mesh(1000, 11);
  KernelProgram program = program_for(GetParam(), mesh);
  std::vector<Ray> rays = random_rays(4096, 17, 1.2);
  const Hits h = closest(program, rays);
  // Just before the nearest hit nothing is in the way, just behind it something is.
  std::vector<Ray> shorter = rays, longer = rays;
  for (std::size_t i = 0; i < rays.size(); i++) {
    if (h.primitive[i] < 0) continue;
    shorter[i].tmax = h.tuv[3 * i];
    longer[i].tmax = h.tuv[3 * i] * 1.00001f;
  }
  std::vector<std::int32_t> blocked_short(rays.size()), blocked_long(rays.size());
  const std::size_t groups = rays.size() / std::size_t(program.lanes());
  program.run_with_scene("probe_occluded", groups, ray_floats(shorter), Out{blocked_short});
  program.run_with_scene("probe_occluded", groups, ray_floats(longer), Out{blocked_long});
  for (std::size_t i = 0; i < rays.size(); i++) {
    EXPECT_EQ(blocked_short[i], 0) << i;
    EXPECT_EQ(blocked_long[i], h.primitive[i] >= 0) << i;
  }
}

TEST_P(Traverse, ExcludedTriangleIsPassed) {
  const Mesh mesh = soup_mesh(300, 23, 0.6);
  KernelProgram program = program_for(GetParam(), mesh);
  std::vector<Ray> rays = random_rays(2048, 29, 1);
  const Hits first = closest(program, rays);
  for (std::size_t i = 0; i < rays.size(); i++) rays[i].exclude = first.primitive[i];
  const Hits second = closest(program, rays);
  for (std::size_t i = 0; i < rays.size(); i++) {
    if (first.primitive[i] < 0) continue;
    EXPECT_NE(second.primitive[i], first.primitive[i]);
    EXPECT_GE(second.primitive[i] < 0 ? 1e18f : second.tuv[3 * i], first.tuv[3 * i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, Traverse,
                         ::testing::Values(Variant{8, 8, true}, Variant{8, 8, false}, Variant{1, 8, true}, Variant{16, 8, true},
                                           Variant{8, 4, true}, Variant{8, 4, false}, Variant{1, 2, false}));

// ---- Watertightness ------------------------------------------------------------------------------------------
/// Rays from inside a closed mesh, aimed at vertices, at points of edges, and at points a few ulps beside them.
std::vector<Ray> edge_rays(const Mesh& mesh, std::size_t n, unsigned seed, layout::Vec3 center, double inner) {
  std::mt19937 g(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::uniform_int_distribution<std::size_t> pick(0, mesh.triangles.size() - 1);
  std::vector<Ray> rays;
  rays.reserve(n);
  for (std::size_t i = 0; i < n; i++) {
    const auto& t = mesh.triangles[pick(g)];
    const layout::Vec3 a = mesh.positions[t.v0], b = mesh.positions[t.v1];
    const double f = i % 3 == 0 ? 0 : 0.5 + 0.5 * u(g);
    const double o[3] = {center.x + inner * u(g), center.y + inner * u(g), center.z + inner * u(g)};
    double p[3] = {a.x + f * (double(b.x) - a.x), a.y + f * (double(b.y) - a.y), a.z + f * (double(b.z) - a.z)};
    if (i % 5 == 0)
      for (double& x : p) x *= 1 + 6e-8 * std::round(3 * u(g));
    // Origins in the planes and on the axes of the mesh meet the special cases of the slabs.
    const bool axial = i % 7 == 0;
    const float ox = float(axial ? center.x : o[0]), oy = float(axial && i % 2 ? center.y : o[1]), oz = float(o[2]);
    rays.push_back(make_ray(ox, oy, oz, p[0] - ox, p[1] - oy, p[2] - oz));
  }
  return rays;
}

class Watertight : public ::testing::TestWithParam<Variant> {};

TEST_P(Watertight, NothingLeavesAClosedMesh) {
  struct Case {
    layout::Vec3 center;
    double radius;
    int rows;
  };
  // At the origin, far from it (coarse coordinates), tiny, and huge.
  const Case cases[] = {{{0, 0, 0}, 1, 64}, {{100, -50, 30}, 1, 48}, {{0.1f, 0.2f, 0}, 1e-3, 32}, {{0, 0, 0}, 1e4, 96}};
  for (const Case& c : cases) {
    const Mesh mesh = sphere_mesh(c.rows, 2 * c.rows, c.center, c.radius);
    KernelProgram program = program_for(GetParam(), mesh);
    const std::vector<Ray> rays = edge_rays(mesh, GetParam().lanes == 8 && GetParam().width == 8 ? 1 << 19 : 1 << 16, 31, c.center, 0.5 * c.radius);
    const Hits h = closest(program, rays);
    std::size_t leaks = 0;
    for (std::int32_t p : h.primitive) leaks += p < 0;
    EXPECT_EQ(leaks, 0u) << "of " << rays.size() << " rays, radius " << c.radius;
  }
}

TEST_P(Watertight, ThinAxisAlignedBoxes) {
  // A box of twelve triangles whose faces and edges lie on the slabs of its BVH, hit along axes and diagonals.
  Mesh m;
  for (int i = 0; i < 8; i++) m.positions.push_back({i & 1 ? 1.f : 0.f, i & 2 ? 1.f : 0.f, i & 4 ? 1.f : 0.f});
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) m.add(layout::uint(f[0]), layout::uint(f[1]), layout::uint(f[2])), m.add(layout::uint(f[0]), layout::uint(f[2]), layout::uint(f[3]));
  KernelProgram program = program_for(GetParam(), m);
  std::vector<Ray> rays;
  const double coordinates[] = {0.25, 0.5, 1e-7, 0.75, 1 - 6e-8};
  for (double x : coordinates)
    for (double y : coordinates)
      for (double z : coordinates)
        for (int dx = -1; dx <= 1; dx++)
          for (int dy = -1; dy <= 1; dy++)
            for (int dz = -1; dz <= 1; dz++)
              if (dx || dy || dz) rays.push_back(make_ray(x, y, z, dx, dy, dz));
  rays.resize(rays.size() / 16 * 16);
  const Hits h = closest(program, rays);
  for (std::size_t i = 0; i < rays.size(); i++) EXPECT_GE(h.primitive[i], 0) << i;
}

INSTANTIATE_TEST_SUITE_P(Variants, Watertight,
                         ::testing::Values(Variant{8, 8, true}, Variant{8, 4, false}, Variant{1, 2, false}));

TEST(TraverseLanes, EveryLaneCountGivesTheSameBits) {
  const Mesh mesh = sphere_mesh(40, 80, {0, 0, 0}, 1, 0.05);
  const std::vector<Ray> rays = random_rays(1 << 14, 41, 1.4);
  std::vector<Hits> all;
  for (int lanes : {1, 8, 16}) {
    KernelProgram program = program_for({lanes, 8, lanes != 1}, mesh);
    all.push_back(closest(program, rays));
  }
  for (const Hits& h : all) {
    EXPECT_EQ(h.primitive, all[0].primitive);
    EXPECT_EQ(std::memcmp(h.tuv.data(), all[0].tuv.data(), h.tuv.size() * 4), 0);
  }
}

// ---- Leaving surfaces ----------------------------------------------------------------------------------------
class Leaving : public ::testing::TestWithParam<int> {};

TEST_P(Leaving, RaysLeavingAConvexMeshOutwardsMeetNothing) {
  const layout::Vec3 centers[] = {{0, 0, 0}, {300, 0, -70}, {0, 0, 0}};
  const double radii[] = {1, 2, 1e5};
  for (int k = 0; k < 3; k++) {
    const Mesh mesh = sphere_mesh(24, 48, centers[k], radii[k]);
    KernelProgram program = program_for({GetParam(), 8, true}, mesh);
    std::mt19937 g(7);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Ray> rays;
    std::vector<float> outwards, inwards;
    const std::size_t n = 1 << 15;
    while (rays.size() < n) {
      // Outwards from inside the ball through a random point; the front is outside, so `next` with z < 0 goes back inside.
      const double c[3] = {centers[k].x, centers[k].y, centers[k].z};
      rays.push_back(make_ray(c[0] + 0.3 * radii[k] * u(g), c[1] + 0.3 * radii[k] * u(g), c[2], u(g), u(g), u(g) + 1e-3));
      const double grazing = rays.size() % 4 ? 1 : 1e-4;
      const double x = u(g), y = u(g), z = grazing * (0.001 + std::abs(u(g))), l = 1 / std::sqrt(x * x + y * y + z * z);
      outwards.insert(outwards.end(), {float(x * l), float(y * l), float(z * l)});
      inwards.insert(inwards.end(), {float(x * l), float(y * l), float(-std::abs(u(g)) - 0.3)});
    }
    for (std::size_t i = 0; i < n; i++) {
      float* d = &inwards[3 * i];
      const float l = 1 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      for (int j = 0; j < 3; j++) d[j] *= l;
    }
    std::vector<std::int32_t> left(n), met(n);
    std::vector<float> t(n);
    const std::size_t groups = n / std::size_t(program.lanes());
    program.run_with_scene("probe_leave", groups, ray_floats(rays), outwards, Out{left}, Out{met}, Out{t});
    std::size_t false_hits = 0, misses = 0, short_hits = 0;
    for (std::size_t i = 0; i < n; i++) {
      ASSERT_GE(left[i], 0);
      false_hits += met[i] >= 0;
    }
    EXPECT_EQ(false_hits, 0u) << "radius " << radii[k];
    program.run_with_scene("probe_leave", groups, ray_floats(rays), inwards, Out{left}, Out{met}, Out{t});
    for (std::size_t i = 0; i < n; i++) misses += met[i] < 0, short_hits += met[i] >= 0 && t[i] < 0.01 * radii[k];
    EXPECT_EQ(misses, 0u) << "radius " << radii[k];
    EXPECT_EQ(short_hits, 0u) << "radius " << radii[k];
  }
}
INSTANTIATE_TEST_SUITE_P(Lanes, Leaving, ::testing::Values(1, 8));

// ---- Another implementation ----------------------------------------------------------------------------------
TEST(TraverseEmbree, AgreesWithRobustMode) {
  Mesh mesh = sphere_mesh(150, 300, {0, 0, 0}, 1, 0.04);
  append(mesh, sphere_mesh(60, 120, {0.9f, 0.5f, 0.2f}, 0.6, 0.1));
  append(mesh, soup_mesh(2000, 5, 0.1));
  KernelProgram program = program_for({8, 8, true}, mesh);
  const std::vector<Ray> rays = random_rays(1 << 17, 43, 1.6);
  const Hits h = closest(program, rays);

  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
  std::memcpy(v, mesh.positions.data(), mesh.positions.size() * 12);
  auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); i++) f[3 * i] = mesh.triangles[i].v0, f[3 * i + 1] = mesh.triangles[i].v1, f[3 * i + 2] = mesh.triangles[i].v2;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);
  int different = 0;
  for (std::size_t i = 0; i < rays.size(); i++) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r{};
    r.ray.org_x = rays[i].o[0], r.ray.org_y = rays[i].o[1], r.ray.org_z = rays[i].o[2];
    r.ray.dir_x = rays[i].d[0], r.ray.dir_y = rays[i].d[1], r.ray.dir_z = rays[i].d[2];
    r.ray.tfar = 1e18f;
    r.ray.mask = ~0u;
    r.hit.geomID = r.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &r);
    const bool hit = r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (hit != (h.primitive[i] >= 0) || (hit && std::abs(r.ray.tfar - h.tuv[3 * i]) > 1e-5f * (1 + r.ray.tfar))) different++;
  }
  // Rays within an ulp of an open edge of the soup may differ.
  EXPECT_LE(different, 3) << "of " << rays.size();
  rtcReleaseScene(scene);
  rtcReleaseGeometry(geometry);
  rtcReleaseDevice(device);
}

}  // namespace
}  // namespace stokes::testing
