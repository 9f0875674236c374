// Quads, spheres and ellipsoids, surface points and clearances of the kernels, against the reference's geometry in double precision.
#include <gtest/gtest.h>

#include <cstring>

#include "reference/intersect.h"
#include "support/kernel_program.h"
#include "compiled/rooms.h"
#include "support/test_shapes.h"

namespace stokes::testing {
namespace {

KernelProgram program_for(const CompiledScene& scene, int lanes, std::vector<std::string> without = {"TRIANGLES", "TEXTURES"}, int width = 8) {
  KernelVariant v;
  v.bvh_width = width;
  v.lanes = lanes;
  v.x86 = lanes != 1;
  v.without = std::move(without);
  KernelProgram program("tests/differential/probes.cl", v);
  program.set_scene(scene);
  return program;
}

Vec3d origin(const Ray& r) { return {r.o[0], r.o[1], r.o[2]}; }
Vec3d direction(const Ray& r) { return {r.d[0], r.d[1], r.d[2]}; }

reference::Hit exact_hit(const CompiledScene& scene, const Ray& r) {
  reference::Hit hit;
  hit.t = r.tmax;
  reference::Ray ray{origin(r), normalize(direction(r)), std::uint32_t(r.exclude)};
  for (std::uint32_t p = 0; p < reference::primitive_count(scene); p++) reference::intersect_primitive(scene, p, ray, 0, hit);
  return hit;
}

std::vector<Ray> rays_in_cube(std::size_t n, unsigned seed, double size) {
  Numbers u(seed);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < n; i++) {
    const Vec3d o = u.cube(size), d = u.direction();
    rays.push_back(make_ray(o.x, o.y, o.z, i % 16 ? d.x : 0, d.y, i % 32 ? d.z : 0));
  }
  return rays;
}

struct Surfaces {
  std::vector<std::int32_t> primitive;
  std::vector<float> words;  // 16 a ray, as probe_surface says
  Vec3d triple(std::size_t ray, int first) const {
    const float* p = &words[16 * ray + std::size_t(first)];
    return {p[0], p[1], p[2]};
  }
};
Surfaces surfaces(KernelProgram& program, const std::vector<Ray>& rays) {
  Surfaces s{std::vector<std::int32_t>(rays.size()), std::vector<float>(rays.size() * 16)};
  program.run_with_scene("probe_surface", rays.size() / std::size_t(program.lanes()), ray_floats(rays), Out{s.primitive}, Out{s.words});
  return s;
}

TEST(KernelShapes, AgreeWithTheReference) {
  const CompiledScene scene = shapes_scene(30, 40, 30, 3);
  KernelProgram program = program_for(scene, 8);
  const std::vector<Ray> rays = rays_in_cube(1 << 14, 7, 1.5);
  std::vector<std::int32_t> primitive(rays.size()), blocked(rays.size());
  std::vector<float> tuv(rays.size() * 3);
  program.run_with_scene("probe_closest", rays.size() / 8, ray_floats(rays), Out{primitive}, Out{tuv});
  program.run_with_scene("probe_occluded", rays.size() / 8, ray_floats(rays), Out{blocked});
  int different = 0, hits = 0;
  for (std::size_t i = 0; i < rays.size(); i++) {
    const reference::Hit e = exact_hit(scene, rays[i]);
    EXPECT_EQ(blocked[i], primitive[i] >= 0) << i;
    if (primitive[i] != std::int32_t(e.primitive)) {
      different++;
      continue;
    }
    if (e.found()) {
      hits++;
      EXPECT_NEAR(tuv[3 * i], e.t, 3e-5 * (1 + e.t)) << i;
    }
  }
  EXPECT_LE(different, 3);
  EXPECT_GT(hits, 4000);
}

TEST(KernelShapes, LargeAndFarSpheres) {
  // A planet underfoot, seen from a metre above; a pea far away; a shell round everything.
  const Vec3d center{0, -6e6, 0};
  CompiledScene scene = shapes_scene(0, 0, 0, 1);
  scene.spheres = {make_sphere(center, 6e6), make_sphere({3000, 40, 0}, 1), make_sphere({0, 0, 0}, 1e7, true)};
  scene.header.sphere_count = 3;
  KernelProgram program = program_for(scene, 8);
  std::vector<Ray> rays;
  Numbers u(3);
  for (int i = 0; i < 4096; i++) {
    if (i % 2) {
      rays.push_back(make_ray(0, 1, 0, u.signed_one(), -0.05 - u.one(), u.signed_one()));
    } else {
      const double a = 0.9 * u.signed_one(), b = 0.3 * u.signed_one();
      rays.push_back(make_ray(0, 40, 0, 3000, a, b));
    }
  }
  const Surfaces s = surfaces(program, rays);
  for (std::size_t i = 0; i < rays.size(); i++) {
    ASSERT_EQ(s.primitive[i], i % 2 ? 0 : 1) << i;
    const reference::Hit e = exact_hit(scene, rays[i]);
    const Vec3d exact = origin(rays[i]) + normalize(direction(rays[i])) * e.t;
    // The planet's coordinates have a grid of half a unit near its radius, its top one of far less.
    EXPECT_LT(length(s.triple(i, 0) - exact), i % 2 ? 8.0 : 2e-2) << i;
  }
}

/// How far p is from the surface of a primitive, in double, along its normal.
double off_surface(const CompiledScene& scene, std::uint32_t primitive, Vec3d p) {
  const reference::PrimitiveRef ref = reference::primitive_ref(scene, primitive);
  switch (ref.kind) {
    case reference::PrimitiveKind::Quad: {
      const layout::Quad& q = scene.quads[ref.index];
      return dot(normalize(reference::vec(q.normal)), p - reference::vec(q.corner));
    }
    case reference::PrimitiveKind::Sphere: {
      const layout::Sphere& s = scene.spheres[ref.index];
      const double outside = length(p - reference::vec(s.center)) - s.radius;
      return s.flip ? -outside : outside;
    }
    case reference::PrimitiveKind::Ellipsoid: {
      const layout::Ellipsoid& e = scene.ellipsoids[ref.index];
      const float* m = e.to_local;
      const Vec3d q{m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                    m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
      const Vec3d gradient{m[0] * q.x + m[4] * q.y + m[8] * q.z, m[1] * q.x + m[5] * q.y + m[9] * q.z, m[2] * q.x + m[6] * q.y + m[10] * q.z};
      const double outside = (dot(q, q) - 1) / (2 * length(gradient));
      return e.flip ? -outside : outside;
    }
    case reference::PrimitiveKind::Triangle: {
      const layout::Triangle& t = scene.triangles[ref.index];
      const Vec3d a = reference::vec(scene.positions[t.v0]);
      const Vec3d n = cross(reference::vec(scene.positions[t.v1]) - a, reference::vec(scene.positions[t.v2]) - a);
      return dot(normalize(n), p - a);
    }
  }
  return 0;
}

void expect_surface_points(const CompiledScene& scene, KernelProgram& program, double size, Vec3d center) {
  std::vector<Ray> rays = rays_in_cube(1 << 13, 17, size);
  for (Ray& r : rays) r = make_ray(r.o[0] + center.x, r.o[1] + center.y, r.o[2] + center.z, r.d[0], r.d[1], r.d[2]);
  const Surfaces s = surfaces(program, rays);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); i++) {
    if (s.primitive[i] < 0) continue;
    hits++;
    const auto primitive = std::uint32_t(s.primitive[i]);
    const float error = s.words[16 * i + 12];
    EXPECT_LE(std::abs(off_surface(scene, primitive, s.triple(i, 0))), error) << i;
    EXPECT_GT(off_surface(scene, primitive, s.triple(i, 9)), 0) << i;
    // The bound is no scene-wide epsilon: some ulps of the coordinates.
    EXPECT_LT(error, 4e-6 * (length(s.triple(i, 0)) + 2 * size)) << i;
    EXPECT_NEAR(length(s.triple(i, 3)), 1, 1e-6);
    EXPECT_GT(dot(s.triple(i, 3), s.triple(i, 6)), 0);
    const reference::Hit e = exact_hit(scene, rays[i]);
    if (e.primitive != primitive) continue;
    const Vec3d exact = origin(rays[i]) + normalize(direction(rays[i])) * e.t;
    const reference::SurfacePoint point = reference::surface_point(scene, primitive, exact, e.u, e.v);
    EXPECT_GT(dot(point.ng, s.triple(i, 3)), 1 - 1e-3) << i;
    EXPECT_EQ(point.surface, &scene.surfaces[std::size_t(*reinterpret_cast<const std::int32_t*>(&s.words[16 * i + 15]))]);
  }
  EXPECT_GT(hits, 1000);
}

TEST(KernelSurface, PositionsLieWithinTheirErrorAndOffsetsBeyondIt) {
  for (double shift : {0.0, 1000.0}) {
    CompiledScene scene = shapes_scene(30, 40, 0, 5);
    for (auto& q : scene.quads) q = make_quad(reference::vec(q.corner) + Vec3d{shift, 0, -shift}, reference::vec(q.edge_u), reference::vec(q.edge_v)), q.surface = 1;
    for (auto& q : scene.spheres) q.center.x += float(shift), q.center.z -= float(shift);
    KernelProgram program = program_for(scene, 8);
    expect_surface_points(scene, program, 1.5, {shift, 0, -shift});
  }
  const CompiledScene ellipsoids = shapes_scene(0, 0, 60, 9);
  KernelProgram program = program_for(ellipsoids, 8);
  expect_surface_points(ellipsoids, program, 1.5, {0, 0, 0});
  for (double shift : {0.0, 1000.0}) {
    Mesh mesh = soup_mesh(300, 7, 0.4);
    for (auto& p : mesh.positions) p.x += float(shift), p.z -= float(shift);
    const CompiledScene scene = mesh_scene(mesh, 8);
    KernelProgram triangles = program_for(scene, 8, {"QUADS", "SPHERES", "ELLIPSOIDS", "TEXTURES"});
    expect_surface_points(scene, triangles, 1.5, {shift, 0, -shift});
  }
}

TEST(KernelSurface, LeavingACurvedSurfaceMeetsOnlyItsFarSide) {
  CompiledScene scene = shapes_scene(0, 2, 2, 1);
  scene.spheres = {make_sphere({0, 0, 0}, 1), make_sphere({500, 20, -3}, 0.25)};
  scene.ellipsoids = {make_ellipsoid({2, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, {10, 0, 0}), make_ellipsoid({0.1, 0, 0}, {0, 3, 1}, {0, 0, 1}, {-70, 5, 0})};
  KernelProgram program = program_for(scene, 8);
  const Vec3d centers[] = {{0, 0, 0}, {500, 20, -3}, {10, 0, 0}, {-70, 5, 0}};
  Numbers u(21);
  std::vector<Ray> rays;
  std::vector<float> out, in;
  for (std::size_t i = 0; i < (1 << 14); i++) {
    const Vec3d d = u.direction(), o = centers[i % 4] - d * 5;
    rays.push_back(make_ray(o.x, o.y, o.z, d.x, d.y, d.z));
    Vec3d next = u.direction();
    next.z = std::abs(next.z) * (i % 3 ? 1 : 1e-5) + 1e-6;
    next = normalize(next);
    out.insert(out.end(), {float(next.x), float(next.y), float(next.z)});
    in.insert(in.end(), {float(next.x), float(next.y), float(-next.z)});
  }
  std::vector<std::int32_t> left(rays.size()), met(rays.size());
  std::vector<float> t(rays.size());
  program.run_with_scene("probe_leave", rays.size() / 8, ray_floats(rays), out, Out{left}, Out{met}, Out{t});
  for (std::size_t i = 0; i < rays.size(); i++) {
    ASSERT_EQ(left[i], int(i % 4));
    EXPECT_NE(met[i], left[i]) << i;
  }
  program.run_with_scene("probe_leave", rays.size() / 8, ray_floats(rays), in, Out{left}, Out{met}, Out{t});
  for (std::size_t i = 0; i < rays.size(); i++) {
    EXPECT_EQ(met[i], left[i]) << i;
    // A chord of a sphere is 2 r cos; near grazing the offset of the origin tells.
    const double radius = i % 4 == 0 ? 1 : 0.25, cosine = -in[3 * i + 2];
    if (i % 4 < 2 && cosine > 0.05) {
      EXPECT_NEAR(t[i], 2 * radius * cosine, 1e-3) << i;
    }
  }
}

TEST(KernelShapes, AQuadBoxHasNoGaps) {
  CompiledScene scene = shapes_scene(0, 0, 0, 1);
  Numbers u(5);
  // A rotated box, away from the origin.
  const Vec3d x = normalize(Vec3d{1, 0.3, -0.2}) * 2, y = normalize(cross({0.1, 0.2, 1}, x)) * 1.5, z = normalize(cross(x, y)) * 0.7, c{12, -5, 3};
  for (int side = 0; side < 2; side++) {
    scene.quads.push_back(make_quad(c + x * side, y, z));
    scene.quads.push_back(make_quad(c + y * side, z, x));
    scene.quads.push_back(make_quad(c + z * side, x, y));
  }
  scene.header.quad_count = 6;
  KernelProgram program = program_for(scene, 8);
  std::vector<Ray> rays;
  for (int i = 0; i < (1 << 17); i++) {
    const auto end = [&] { return u.one() < 0.5 ? 0.0 : 1.0; };
    const Vec3d p = c + x * end() + y * end() + z * (i % 2 ? u.one() : end()), o = c + x * (0.1 + 0.8 * u.one()) + y * (0.1 + 0.8 * u.one()) + z * 0.5;
    rays.push_back(make_ray(o.x, o.y, o.z, p.x - float(o.x), p.y - float(o.y), p.z - float(o.z)));
  }
  const Surfaces s = surfaces(program, rays);
  int leaks = 0;
  for (std::int32_t p : s.primitive) leaks += p < 0;
  EXPECT_EQ(leaks, 0);
}

/// A room without a front, a boundary close round it, and shapes inside.
CompiledScene room_scene() {
  CompiledScene scene = shapes_scene(4, 4, 0, 9);
  for (const double r : {1.0, 1.001})
    for (int axis = 0; axis < 3; axis++)
      for (const double side : {-r, r}) {
        if (r == 1 && axis == 2 && side > 0) continue;
        const Vec3d x = axis == 0 ? Vec3d{1, 0, 0} : axis == 1 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}, y{x.z, x.x, x.y}, z{x.y, x.z, x.x};
        scene.quads.push_back(make_quad(x * side - y * r - z * r, y * (2 * r), z * (2 * r)));
      }
  scene.header.quad_count = layout::uint(scene.quads.size());
  const std::vector<layout::Room> rooms = compiled::find_rooms(scene.quads);
  scene.header.room_count = layout::uint(rooms.size());
  for (std::size_t i = 0; i < rooms.size(); i++) scene.header.rooms[i] = rooms[i];
  scene.header.room_quads[0] = 0x7ff0;
  return scene;
}

TEST(KernelShapes, RoomsAreTheirWalls) {
  const CompiledScene scene = room_scene();
  ASSERT_EQ(scene.header.room_count, 2u);
  std::vector<Ray> rays = rays_in_cube(1 << 14, 7, 1.0);
  Numbers u(8);
  for (std::size_t i = 0; i < rays.size(); i++) {
    Ray& r = rays[i];
    // Whole groups of lanes inside, short ones and long ones; some outside; some that start on a wall.
    if (i / 8 % 4 == 0)
      for (float& x : r.o) x *= 1.6f;
    if (i % 3 == 0) r.tmax = float(0.5 + u.one());
    if (i / 8 % 4 == 1) {
      const layout::Quad& wall = scene.quads[4 + i % 11];
      const Vec3d p = reference::vec(wall.corner) + reference::vec(wall.edge_u) * u.one() + reference::vec(wall.edge_v) * u.one();
      // A little off it, to either side, as rounding may leave it.
      r.o[0] = float(p.x + 2e-6 * u.signed_one()), r.o[1] = float(p.y + 2e-6 * u.signed_one()), r.o[2] = float(p.z + 2e-6 * u.signed_one());
      r.exclude = std::int32_t(4 + i % 11);
    }
  }
  for (const int lanes : {1, 8}) {
    KernelProgram program = program_for(scene, lanes);
    std::vector<std::int32_t> primitive(rays.size()), blocked(rays.size());
    std::vector<float> tuv(rays.size() * 3);
    program.run_with_scene("probe_closest", rays.size() / std::size_t(lanes), ray_floats(rays), Out{primitive}, Out{tuv});
    program.run_with_scene("probe_occluded", rays.size() / std::size_t(lanes), ray_floats(rays), Out{blocked});
    int different = 0, walls = 0;
    for (std::size_t i = 0; i < rays.size(); i++) {
      const reference::Hit e = exact_hit(scene, rays[i]);
      different += (blocked[i] != 0) != e.found();
      if (primitive[i] != std::int32_t(e.primitive)) {
        different++;
      } else if (e.found()) {
        walls += e.primitive >= 4 && e.primitive < 15;
        EXPECT_NEAR(tuv[3 * i], e.t, 3e-5 * (1 + e.t)) << i;
      }
    }
    EXPECT_LE(different, 8);
    EXPECT_GT(walls, 5000);
  }
}

TEST(KernelShapes, EveryLaneCountGivesTheSameBits) {
  CompiledScene scene = shapes_scene(10, 10, 10, 3);
  const CompiledScene mesh = mesh_scene(soup_mesh(500, 3), 8);
  scene.positions = mesh.positions, scene.triangles = mesh.triangles, scene.bvh_nodes = mesh.bvh_nodes, scene.bvh_leaves = mesh.bvh_leaves;
  scene.header.triangle_count = mesh.header.triangle_count;
  const std::vector<Ray> rays = rays_in_cube(1 << 13, 7, 1.5);
  std::vector<Surfaces> all;
  for (int lanes : {1, 8, 16}) {
    KernelProgram program = program_for(scene, lanes, {"SMOOTH_NORMALS"});
    all.push_back(surfaces(program, rays));
  }
  for (const Surfaces& s : all) {
    EXPECT_EQ(s.primitive, all[0].primitive);
    EXPECT_EQ(std::memcmp(s.words.data(), all[0].words.data(), s.words.size() * 4), 0);
  }
}

// ---- Clearance -----------------------------------------------------------------------------------------------
/// Distance from p to a triangle (Ericson 2005, section 5.1.5).
double triangle_distance(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return length(ap);
  if (d3 >= 0 && d4 <= d3) return length(bp);
  if (d6 >= 0 && d5 <= d6) return length(cp);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 / (d1 - d3)));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 / (d2 - d6)));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double denominator = 1 / (va + vb + vc);
  return length(ap - ab * (vb * denominator) - ac * (vc * denominator));
}

TEST(KernelClearance, IsALowerBoundAndAUsefulOne) {
  for (int kind = 0; kind < 4; kind++) {
    CompiledScene scene = kind == 3 ? mesh_scene(sphere_mesh(20, 40, {0.1f, 0, 0}, 0.8), 8) : shapes_scene(kind == 0 ? 12 : 0, kind == 1 ? 12 : 0, kind == 2 ? 12 : 0, 3);
    KernelProgram program = program_for(scene, 8, {"TEXTURES", kind == 3 ? "QUADS" : "TRIANGLES"});
    Numbers u(31);
    std::vector<float> points, clear(4096);
    for (int i = 0; i < 4096; i++) {
      const Vec3d p = u.cube(1.2);
      points.insert(points.end(), {float(p.x), float(p.y), float(p.z)});
    }
    program.run_with_scene("probe_clearance", clear.size() / 8, 0.5f, points, Out{clear});
    double sum_clear = 0, sum_true = 0;
    for (std::size_t i = 0; i < clear.size(); i++) {
      const Vec3d p{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
      double exact = 0.5;
      for (const auto& q : scene.quads) {
        const Vec3d a = reference::vec(q.corner), eu = reference::vec(q.edge_u), ev = reference::vec(q.edge_v);
        exact = std::min({exact, triangle_distance(p, a, a + eu, a + eu + ev), triangle_distance(p, a, a + eu + ev, a + ev)});
      }
      for (const auto& q : scene.spheres) exact = std::min(exact, std::abs(length(p - reference::vec(q.center)) - q.radius));
      for (const auto& t : scene.triangles)
        exact = std::min(exact, triangle_distance(p, reference::vec(scene.positions[t.v0]), reference::vec(scene.positions[t.v1]), reference::vec(scene.positions[t.v2])));
      for (const auto& e : scene.ellipsoids)  // by a dense sample of the surface
        for (int k = 0; k < 400; k++) {
          const double z = 1 - 2 * (k + 0.5) / 400, phi = 2.399963 * k, r = std::sqrt(1 - z * z), q[3] = {r * std::cos(phi), r * std::sin(phi), z};
          const float* m = e.to_world;
          const Vec3d w{m[0] * q[0] + m[1] * q[1] + m[2] * q[2] + m[3], m[4] * q[0] + m[5] * q[1] + m[6] * q[2] + m[7],
                        m[8] * q[0] + m[9] * q[1] + m[10] * q[2] + m[11]};
          exact = std::min(exact, length(p - w));
        }
      ASSERT_LE(clear[i], exact * (1 + 1e-6)) << "kind " << kind << " point " << i;
      sum_clear += clear[i], sum_true += exact;
    }
    EXPECT_GT(sum_clear, (kind == 2 ? 0.3 : 0.8) * sum_true) << "kind " << kind;
  }
}

TEST(KernelClearance, NoTriangleIsNearButThoseOfTwoLeaves) {
  for (const int width : {8, 2}) {
    const CompiledScene scene = mesh_scene(sphere_mesh(40, 80, {0.1f, 0, 0}, 0.8), width);
    KernelProgram program = program_for(scene, 8, {"TEXTURES", "QUADS"}, width);
    Numbers u(37);
    constexpr int kRays = 8192;
    std::vector<float> points, directions, known(kRays), t(kRays), t_near(kRays);
    std::vector<int> met(kRays), met_near(kRays);
    for (int i = 0; i < kRays; i++) {
      const Vec3d out = normalize(u.cube(1)), d = normalize(u.cube(1)), p = Vec3d{0.1, 0, 0} + out * (0.8 + 0.04 * u.cube(1).x);
      points.insert(points.end(), {float(p.x), float(p.y), float(p.z)});
      directions.insert(directions.end(), {float(d.x), float(d.y), float(d.z)});
    }
    program.run_with_scene("probe_neighbourhood", kRays / 8, 0.2f, points, directions, Out{known}, Out{met}, Out{met_near}, Out{t}, Out{t_near});
    int hits = 0;
    double sum = 0;
    for (int i = 0; i < kRays; i++) {
      ASSERT_EQ(met[i], met_near[i]) << "width " << width << " ray " << i;
      if (met[i] < 0) continue;
      ASSERT_EQ(t[i], t_near[i]) << "width " << width << " ray " << i;
      hits++;
      sum += known[i];
    }
    std::printf("width %d: %d of %d rays hit, known %.4f\n", width, hits, kRays, sum / hits);
    EXPECT_GT(hits, kRays / 10) << "of " << kRays;
  }
}

}  // namespace
}  // namespace stokes::testing
