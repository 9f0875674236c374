// The skin preset as the reader expands it, and the units of generated meshes.
#include <cmath>

#include "mesh/mesh_distance.h"
#include "spectral/skin.h"
#include "spectral/tabulate.h"
#include "unit/scene_support.h"

namespace stokes {
namespace {

// A scene of one surface of skin; `unit` such as `"scene unit": "cm",`.
std::string skin_scene(const std::string& surface, const std::string& material = "", const std::string& unit = "") {
  return "{\"camera\": {}, " + unit + R"("materials": [{"type": "skin", "name": "s")" + material +
         R"(}, {"type": "lambertian", "name": "paint"}], "surfaces": [)" + surface + "]}";
}

TEST(SceneSkin, QuadBecomesTwoBoundaries) {
  const SceneDescription scene = parse(skin_scene(
      R"({"type": "quad", "name": "q", "size": 3, "material": "s", "emit": 1, "transform": [{"scale": 2}, {"rotate": [90, 0, 1, 0]}]})",
      R"(, "melanosome fraction": 0.1, "blood fraction": 0.02, "oxygenation": 0.6, "epidermis thickness": 0.1, "g": 0.9, "ior": 1.37, "alpha": 0.2)",
      R"("scene unit": "cm", )"));
  ASSERT_EQ(scene.surfaces.size(), 2u);
  const SurfaceDescription &outer = scene.surfaces[0], &inner = scene.surfaces[1];
  EXPECT_EQ(outer.material->kind, MaterialKind::Dielectric);
  EXPECT_EQ(outer.material->ior->value, 1.37);
  EXPECT_EQ(outer.material->alpha, 0.2);
  EXPECT_EQ(inner.material->kind, MaterialKind::Interface);
  EXPECT_EQ(outer.outside, nullptr);
  EXPECT_EQ(outer.inside, inner.outside);
  EXPECT_EQ(inner.inside->name, "dermis");
  EXPECT_EQ(inner.emit, nullptr);
  EXPECT_NE(outer.emit, nullptr);
  EXPECT_EQ(inner.width, 3);
  // The normal is +x, and 0.1 mm are 0.01 cm, whatever the transform enlarges.
  EXPECT_NEAR(inner.transform.point({0, 0, 0}).x, -0.01, 1e-12);
  const SkinComposition skin{.melanosomes = 0.1, .blood = 0.02, .saturation = 0.6, .g = 0.9};
  const MediumDescription &epidermis = *outer.inside, &dermis = *inner.inside;
  EXPECT_EQ(epidermis.unit, LengthUnit::Millimetre);
  for (const double l : {400.0, 550.0, 700.0}) {
    const auto at = [&](const SpectrumPtr& s) { return evaluate(*s, SpectrumRole::Coefficient, l); };
    EXPECT_NEAR(at(epidermis.sigma_a) * 10, evaluate(epidermis_sigma_a(skin), SpectrumRole::Coefficient, l), 1e-9);  // per mm, not per cm
    EXPECT_NEAR(at(dermis.sigma_a) * 10, evaluate(dermis_sigma_a(skin), SpectrumRole::Coefficient, l), 1e-9);
    EXPECT_NEAR(at(dermis.sigma_s) * 10, evaluate(skin_sigma_s(skin), SpectrumRole::Coefficient, l), 1e-9);
    EXPECT_NEAR(at(epidermis.g), 0.9, 1e-12);
  }
}

TEST(SceneSkin, FlippedQuadAndTriangleSinkTheOtherWay) {
  const auto sunk = [](const std::string& json) { return parse(skin_scene(json)).surfaces.at(1).transform.translation().z; };
  EXPECT_NEAR(sunk(R"({"type": "quad", "material": "s"})"), -0.06, 1e-12);
  EXPECT_NEAR(sunk(R"({"type": "quad", "material": "s", "flip": true})"), 0.06, 1e-12);
  EXPECT_NEAR(sunk(R"({"type": "triangle", "material": "s", "v0": [0,0,0], "v1": [1,0,0], "v2": [0,1,0]})"), -0.06, 1e-12);
}

TEST(SceneSkin, SphereShrinksInWorldSpace) {
  const SceneDescription scene =
      parse(skin_scene(R"({"type": "sphere", "radius": 2, "material": "s", "transform": {"scale": 3}})", "", R"("scene unit": "mm", )"));
  EXPECT_NEAR(scene.surfaces.at(1).radius, 2 - 0.02, 1e-12);
  EXPECT_NEAR(parse(skin_scene(R"({"type": "sphere", "material": "s", "flip": true})")).surfaces.at(1).radius, 1.06, 1e-12);
}

TEST(SceneSkin, MeshGetsAParallelOne) {
  const SceneDescription scene = parse(skin_scene(R"({"type": "mesh", "generator": "hand", "resolution": 4, "material": "s"})",
                                                  R"(, "epidermis thickness": 0.5)", R"("scene unit": "m", )"));
  ASSERT_EQ(scene.surfaces.size(), 2u);
  MeshData outer = *scene.surfaces[0].mesh;
  const MeshDistance distance(outer);
  double worst = 0;
  for (const Vec3d& p : scene.surfaces[1].mesh->positions) worst = std::max(worst, std::abs(distance(p) / -0.0005 - 1));
  EXPECT_LT(worst, 0.05);
}

// Painted skin is skin under paint: the layers lie below the blend.
TEST(SceneSkin, PaintLiesOnSkin) {
  const SceneDescription scene = parse(
      skin_scene(R"({"type": "quad", "material": {"type": "painted", "base": "s", "paint": "paint", "mask": 0.5}})"));
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].material->kind, MaterialKind::Blend);
  EXPECT_EQ(scene.surfaces[0].inside->name, "epidermis");
  EXPECT_EQ(scene.surfaces[1].inside->name, "dermis");
}

TEST(SceneSkin, BadOnesGiveTheirPlace) {
  const auto expect = [](const std::string& surface, const std::string& material, const std::string& message) {
    const std::string line = error_of(skin_scene(surface, material));
    EXPECT_THAT(line, testing::HasSubstr(": error: " + message));
  };
  const std::string quad = R"({"type": "quad", "material": "s"})";
  expect(quad, R"(, "melanosome fraction": 1.5)", "/materials/0/melanosome fraction: 1.5 is outside [0, 1]");
  expect(quad, R"(, "oxygenation": -1)", "/materials/0/oxygenation: ");
  expect(quad, R"(, "epidermis thickness": 0)", "/materials/0/epidermis thickness: ");
  expect(quad, R"(, "g": 1)", "/materials/0/g: ");
  expect(quad, R"(, "melanin": 0.2)", "/materials/0/melanin: unknown key");
  expect(R"({"type": "quad", "material": "s", "inside": {"type": "homogeneous", "sigma_t": 1, "albedo": 0.5}})", "",
         "/surfaces/0/inside: skin has its own layers inside");
  expect(R"({"type": "sphere", "radius": 0.05, "material": "s"})", "", "/surfaces/0: the sphere is smaller");
  expect(R"({"type": "sphere", "material": "s", "transform": {"scale": [1, 1, 2]}})", "", "/surfaces/0: skin on a sphere needs");
  expect(R"({"type": "quad", "material": {"type": "blend", "a": "s", "b": {"type": "skin"}}})", "", "/surfaces/0: a surface cannot be two skins");
  const TemporaryFolder folder;
  folder.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(folder.error_of(skin_scene(R"({"type": "mesh", "filename": "open.obj", "material": "s"})")),
              testing::HasSubstr("/surfaces/0: skin on this mesh: the mesh is not closed"));
}

TEST(SceneUnits, GeneratedMeshesAreInMillimetres) {
  const auto top = [](const std::string& unit) {
    double y = 0;
    const std::string head = R"("surfaces": [{"type": "mesh", "generator": "head", "resolution": 10, "material": {"type": "metal"}}])";
    const auto scene = parse(with(unit + head));
    for (const Vec3d& p : scene.surfaces.at(0).mesh->positions) y = std::max(y, p.y);
    return y;
  };
  const double mm = top("");
  EXPECT_NEAR(mm, 111, 3);
  EXPECT_NEAR(top(R"("scene unit": "mm", )"), mm, 1e-9);
  EXPECT_NEAR(top(R"("scene unit": "cm", )"), mm / 10, 1e-9);
  EXPECT_NEAR(top(R"("scene unit": "m", )"), mm / 1000, 1e-9);
}

}  // namespace
}  // namespace stokes
