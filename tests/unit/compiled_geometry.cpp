// Primitives in world space: sizes, affine transforms, flips, mirrors, degenerate input, the camera.
#include <numbers>

#include "compiled/shapes.h"
#include "compiled_scenes.h"

namespace stokes::test {
namespace {

using compiled::to_double;
constexpr double kPi = std::numbers::pi;

void expect_near(Vec3d a, Vec3d b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(CompiledQuad, HasItsSizeAndFaces) {
  const CompiledScene s = compile_scene(scene_of({quad(lambertian(), translate({1, 2, 3}), 4, 6)}));
  ASSERT_EQ(s.quads.size(), 1u);
  const layout::Quad& q = s.quads[0];
  expect_near(to_double(q.corner), {-1, -1, 3});
  expect_near(to_double(q.normal), {0, 0, 1});
  EXPECT_FLOAT_EQ(q.area, 24);
  EXPECT_FLOAT_EQ(q.offset, 3);
  EXPECT_TRUE(s.features.quads);
  EXPECT_FALSE(s.features.triangles);
}

// A sheared, scaled and mirrored quad: u and v of its points, and the normal as the inverse transpose gives it.
TEST(CompiledQuad, IsAParallelogramUnderAnyAffineMap) {
  const Affine shear{{2, 0.5, 0.3, 1, 0, -1.5, 0.2, 2, 0.4, 0, 1, 3}};
  ASSERT_LT(shear.determinant(), 0);
  for (const bool flip : {false, true}) {
    SurfaceDescription d = quad(lambertian(), shear, 2, 1);
    d.flip = flip;
    const CompiledScene s = compile_scene(scene_of({d}));
    const layout::Quad& q = s.quads[0];
    for (const double u : {0.0, 0.25, 1.0})
      for (const double v : {0.0, 0.5, 1.0}) {
        const Vec3d p = shear.point({-1 + 2 * u, -0.5 + v, 0});
        EXPECT_NEAR(dot(to_double(q.dual_u), p) - q.u0, u, 1e-6);
        EXPECT_NEAR(dot(to_double(q.dual_v), p) - q.v0, v, 1e-6);
        EXPECT_NEAR(dot(to_double(q.normal), p), q.offset, 1e-6);
      }
    expect_near(to_double(q.normal), normalize(shear.normal({0, 0, 1})) * (flip ? -1.0 : 1.0));
    EXPECT_NEAR(q.area, length(cross(shear.vector({2, 0, 0}), shear.vector({0, 1, 0}))), 1e-5);
  }
}

TEST(CompiledQuad, WithoutAreaIsDroppedWithAWarning) {
  const CompiledScene s = compile_scene(scene_of({quad(lambertian(), scale({1, 0, 1}))}));
  EXPECT_TRUE(s.quads.empty());
  ASSERT_FALSE(s.warnings.empty());
  EXPECT_NE(s.warnings[0].find("without area"), std::string::npos);
}

TEST(CompiledQuad, ManyBecomeTrianglesWithTheirTextureCoordinates) {
  for (const std::size_t n : {64u, 65u}) {
    std::vector<SurfaceDescription> quads(n, quad(lambertian(), scale({1, -1, 1}), 2, 3));
    const CompiledScene s = compile_scene(scene_of(quads));
    EXPECT_EQ(s.quads.size(), n == 64 ? 64u : 0u);
    EXPECT_EQ(s.triangles.size(), n == 64 ? 0u : 130u);
    if (n == 64) continue;
    double area = 0;
    for (const layout::Triangle& t : s.triangles) {
      area += t.area;
      const Vec3d a = to_double(s.positions[t.v0]), b = to_double(s.positions[t.v1]), c = to_double(s.positions[t.v2]);
      EXPECT_GT(cross(b - a, c - a).z, 0);
      EXPECT_FLOAT_EQ(s.uvs[2 * t.v1], float(b.x / 2 + 0.5));
      EXPECT_FLOAT_EQ(s.uvs[2 * t.v1 + 1], float(-b.y / 3 + 0.5));
    }
    EXPECT_NEAR(area, 65 * 6, 1e-3);
    EXPECT_EQ(s.surfaces.size(), 65u);
    EXPECT_TRUE(s.surfaces[0].flags & SURFACE_HAS_UV);
  }
}

TEST(CompiledSphere, StaysASphereUnderRotationScaleAndReflection) {
  const Affine a = translate({1, 2, 3}) * rotate_z(0.3) * rotate_x(1.1) * scale({-2, 2, 2});
  const CompiledScene s = compile_scene(scene_of({sphere(lambertian(), a, 1.5)}));
  ASSERT_EQ(s.spheres.size(), 1u);
  EXPECT_TRUE(s.ellipsoids.empty());
  const layout::Sphere& p = s.spheres[0];
  EXPECT_FLOAT_EQ(p.radius, 3);
  EXPECT_EQ(p.flip, 0u);
  expect_near(to_double(p.center), {1, 2, 3});
  // to_local undoes the linear part, up to the scale.
  const Vec3d local{0.1, -0.7, 0.4}, world = a.vector(local);
  for (int i = 0; i < 3; i++)
    EXPECT_NEAR((p.to_local[3 * i] * world.x + p.to_local[3 * i + 1] * world.y + p.to_local[3 * i + 2] * world.z) / 2, local[i], 1e-6);
}

TEST(CompiledSphere, BecomesAnEllipsoidOtherwise) {
  const Affine a = translate({1, 2, 3}) * rotate_z(0.3) * scale({1, 1, 2});
  const CompiledScene s = compile_scene(scene_of({sphere(lambertian(), a, 1.5)}));
  ASSERT_EQ(s.ellipsoids.size(), 1u);
  EXPECT_TRUE(s.spheres.empty());
  EXPECT_TRUE(s.features.ellipsoids);
  const layout::Ellipsoid& e = s.ellipsoids[0];
  const Vec3d p = a.point({0, 0, 1.5});
  for (int i = 0; i < 3; i++) {
    const float* row = e.to_local + 4 * i;
    EXPECT_NEAR(row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3], i == 2 ? 1 : 0, 1e-6);
  }
  // Prolate spheroid with semi-axes 1.5, 1.5 and 3: closed form.
  const double eccentricity = std::sqrt(1 - 0.25);
  EXPECT_NEAR(e.area, 2 * kPi * 2.25 * (1 + 2 / eccentricity * std::asin(eccentricity)), 1e-3);
}

TEST(CompiledSphere, KnowsTheAreaOfEllipsoids) {
  const auto area = [](Vec3d axes) { return double(compiled::make_ellipsoid(scale(axes), 1, false).area); };
  // Prolate and oblate spheroids have elementary areas.
  const double e = std::sqrt(3.0) / 2;
  EXPECT_NEAR(area({1, 1, 2}), 2 * kPi * (1 + 2 / e * std::asin(e)), 1e-5);
  EXPECT_NEAR(area({2, 1, 2}), 2 * kPi * (4 + std::atanh(e) / e), 1e-5);
  // The needle's and the disc's limits, a sphere but for a rounding, and nothing that is not finite between them.
  EXPECT_NEAR(area({1, 1e-5, 1e-5}) / (kPi * kPi * 1e-5), 1, 1e-5);
  EXPECT_NEAR(area({1, 3, 1e-9}), 2 * kPi * 3, 1e-5);
  EXPECT_NEAR(area({1, 1, 1 + 1e-6}), 4 * kPi, 3e-5);
  EXPECT_NEAR(area({1e-15, 2e-15, 3e-15}) * 1e30, area({1, 2, 3}), 1e-4);
  // Three different axes, by a quadrature of the elliptic integral to eight digits.
  EXPECT_NEAR(area({3, -1, 2}), 48.882151, 1e-4);
}

TEST(CompiledSphere, RefusesSingularTransformsAndFlipsForNegativeRadii) {
  EXPECT_NE(error_of(scene_of({sphere(lambertian(), scale({1, 1, 0}))})).find("invertible"), std::string::npos);
  EXPECT_NE(error_of(scene_of({sphere(lambertian(), {}, 0)})).find("radius"), std::string::npos);
  EXPECT_EQ(compile_scene(scene_of({sphere(lambertian(), {}, -1)})).spheres[0].flip, 1u);
}

// The front side is that of the local winding's normal, transformed as a normal; a mirror does not turn a mesh inside out.
TEST(CompiledMesh, KeepsItsFrontSideUnderMirrorsAndTurnsItByFlip) {
  for (const double z : {1.0, -1.0})
    for (const double x : {1.0, -1.0})
      for (const bool flip : {false, true}) {
        SurfaceDescription d = mesh(lambertian(), one_triangle(), scale({x, 1, z}));
        d.flip = flip;
        const CompiledScene s = compile_scene(scene_of({d}));
        const layout::Triangle& t = s.triangles.at(0);
        const Vec3d a = to_double(s.positions[t.v0]), b = to_double(s.positions[t.v1]), c = to_double(s.positions[t.v2]);
        expect_near(normalize(cross(b - a, c - a)), {0, 0, z * (flip ? -1 : 1)});
        EXPECT_FLOAT_EQ(t.area, 0.5f);
      }
}

TEST(CompiledMesh, TransformsShadingNormalsAndKeepsTextureCoordinates) {
  MeshData m = one_triangle();
  m.normals.assign(3, normalize(Vec3d{1, 0, 1}));
  m.uvs = {{0, 0}, {1, 0}, {0, 1}};
  SurfaceDescription d = mesh(lambertian(), m, scale({2, 1, 1}));
  d.flip = true;
  const CompiledScene s = compile_scene(scene_of({mesh(lambertian(), one_triangle()), d}));
  ASSERT_EQ(s.normals.size(), 6u);
  ASSERT_EQ(s.uvs.size(), 12u);
  EXPECT_EQ(s.normals[0].z, 0);  // the mesh without normals
  expect_near(to_double(s.normals[3]), -normalize(Vec3d{0.5, 0, 1}));
  EXPECT_FALSE(s.surfaces[0].flags & SURFACE_SMOOTH_NORMALS);
  EXPECT_TRUE(s.surfaces[1].flags & SURFACE_SMOOTH_NORMALS);
  const layout::Triangle& t = s.triangles[1];
  for (std::uint32_t v : {t.v0, t.v1, t.v2}) {
    EXPECT_FLOAT_EQ(s.uvs[2 * v], s.positions[v].x / 2);
    EXPECT_FLOAT_EQ(s.uvs[2 * v + 1], s.positions[v].y);
  }
}

TEST(CompiledMesh, DropsDegenerateTrianglesAndRefusesBadOnes) {
  MeshData m = one_triangle();
  m.triangles.push_back({0, 1, 1});
  const CompiledScene s = compile_scene(scene_of({mesh(lambertian(), m)}));
  EXPECT_EQ(s.triangles.size(), 1u);
  ASSERT_FALSE(s.warnings.empty());
  EXPECT_NE(s.warnings[0].find("1 degenerate"), std::string::npos);
  m.triangles = {{0, 1, 7}};
  EXPECT_NE(error_of(scene_of({mesh(lambertian(), m)})).find("vertex 7"), std::string::npos);
  m = one_triangle();
  m.positions[1].x = NAN;
  EXPECT_NE(error_of(scene_of({mesh(lambertian(), m)})).find("not finite"), std::string::npos);
}

TEST(CompiledCamera, HasAnUnscaledBasis) {
  SceneDescription d = scene_of({quad(lambertian())});
  d.camera.transform = translate({0, 0, 5}) * scale({2, 2, 2});
  d.camera.vfov = 60;
  d.camera.width = 200, d.camera.height_pixels = 100;
  d.camera.aperture = 0.25, d.camera.fdist = 3;
  const layout::Camera camera = compile_scene(d).header.camera;
  expect_near(to_double(camera.axis_x), {1, 0, 0});
  EXPECT_NEAR(camera.half_height, std::tan(kPi / 6), 1e-6);
  EXPECT_NEAR(camera.half_width, 2 * std::tan(kPi / 6), 1e-6);
  EXPECT_FLOAT_EQ(camera.lens_radius, 0.5f);
  EXPECT_FLOAT_EQ(camera.focal_distance, 6);
  d.camera.orthographic = true;
  d.camera.height = 3;
  EXPECT_NEAR(compile_scene(d).header.camera.half_height, 3, 1e-6);
  d.camera.vfov = 180;
  d.camera.orthographic = false;
  EXPECT_NE(error_of(d).find("vfov"), std::string::npos);
}

TEST(CompiledScene, KnowsItsBounds) {
  const CompiledScene s = compile_scene(scene_of({sphere(lambertian(), translate({1, 0, 0}), 1), quad(lambertian(), translate({-3, 0, 0}), 2, 2)}));
  // Box: [-4, 2] x [-1, 1] x [-1, 1].
  expect_near(to_double(s.header.scene_center), {-1, 0, 0});
  EXPECT_NEAR(s.header.scene_radius, std::sqrt(11.0), 1e-5);
}

// Faces of a cube round the origin: 0 and 1 across x, 2 and 3 across y, 4 and 5 across z, the lower one first.
std::vector<SurfaceDescription> walls(std::initializer_list<int> faces, double side = 2) {
  std::vector<SurfaceDescription> surfaces;
  for (const int f : faces) {
    const Affine across_x{{0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0}};
    const Affine turn = f < 2 ? across_x : f < 4 ? rotate_x(-kPi / 2) : translate({});
    surfaces.push_back(quad(lambertian(), turn * translate({0, 0, f % 2 == 0 ? -side / 2 : side / 2}), side, side));
  }
  return surfaces;
}

TEST(CompiledScene, KnowsItsRooms) {
  std::vector<SurfaceDescription> surfaces = walls({3, 0, 1, 4, 2});
  surfaces.push_back(quad(lambertian(), translate({0, 0, -0.5}), 2, 2));
  const layout::Scene h = compile_scene(scene_of(surfaces)).header;
  ASSERT_EQ(h.room_count, 1u);
  EXPECT_EQ(h.room_quads[0], 31u);
  expect_near(to_double(h.rooms[0].low), {-1, -1, -1});
  expect_near(to_double(h.rooms[0].high), {1, 1, 1});
  const int faces[] = {1, 2, 4, 0, 3, -1};
  for (int f = 0; f < 6; f++) EXPECT_EQ(h.rooms[0].faces[f], faces[f]) << f;
}

TEST(CompiledScene, RoomsMayLieWithinRooms) {
  std::vector<SurfaceDescription> surfaces = walls({0, 1, 2, 3});
  for (const SurfaceDescription& s : walls({0, 1, 2, 3, 4, 5}, 2.002)) surfaces.push_back(s);
  const layout::Scene h = compile_scene(scene_of(surfaces)).header;
  ASSERT_EQ(h.room_count, 2u);
  EXPECT_EQ(h.room_quads[0], 0x3ffu);
  EXPECT_EQ(h.rooms[0].faces[0], 4) << "most faces first";
  EXPECT_EQ(h.rooms[1].faces[5], -1);
}

TEST(CompiledScene, TwoWallsAreNoRoom) { EXPECT_EQ(compile_scene(scene_of(walls({0, 1}))).header.room_count, 0u); }

TEST(CompiledScene, WallsWithAGapAreNoRoom) {
  std::vector<SurfaceDescription> surfaces = walls({0, 1, 2});
  surfaces[2] = quad(lambertian(), rotate_x(-kPi / 2) * translate({0, 0, -1}), 2, 1.999);
  EXPECT_EQ(compile_scene(scene_of(surfaces)).header.room_count, 0u);
}

// Which of the two is seen depends on their order, and must go on to.
TEST(CompiledScene, AWallWithALampInItsPlaneIsNoFace) {
  std::vector<SurfaceDescription> surfaces = walls({0, 1, 2, 3});
  surfaces.push_back(quad(lambertian(), rotate_x(-kPi / 2) * translate({0, 0, 1}), 0.5, 0.5));
  const layout::Scene h = compile_scene(scene_of(surfaces)).header;
  ASSERT_EQ(h.room_count, 1u);
  EXPECT_EQ(h.room_quads[0], 7u);
}

}  // namespace
}  // namespace stokes::test
