// Media: pairs of coefficients, units, and what is refused; the medium that the camera stands in.
#include "compiled_scenes.h"

namespace stokes::test {
namespace {

MediumDescription medium() {
  MediumDescription m;
  m.pointer = "/media/0";
  m.name = "m";
  return m;
}
MediumPtr share(MediumDescription m) { return std::make_shared<const MediumDescription>(std::move(m)); }

// A sphere filled with the medium.
SceneDescription filled(MediumDescription m) {
  SurfaceDescription s = sphere(lambertian());
  s.inside = share(std::move(m));
  return scene_of({s});
}

struct Pair {
  const char* name;
  SpectrumPtr MediumDescription::*first;
  double a;
  SpectrumPtr MediumDescription::*second;
  double b;
};

// sigma_t 4, sigma_s 3, sigma_a 1, albedo 0.75, in every pair that determines the rest.
TEST(CompiledMedium, TakesAnyTwoThatDetermineTheRest) {
  using M = MediumDescription;
  for (const Pair& p : {Pair{"sigma_t sigma_s", &M::sigma_t, 4, &M::sigma_s, 3}, {"sigma_t sigma_a", &M::sigma_t, 4, &M::sigma_a, 1},
                        {"sigma_t albedo", &M::sigma_t, 4, &M::albedo, 0.75}, {"sigma_s sigma_a", &M::sigma_s, 3, &M::sigma_a, 1},
                        {"sigma_s albedo", &M::sigma_s, 3, &M::albedo, 0.75}, {"sigma_a albedo", &M::sigma_a, 1, &M::albedo, 0.75}}) {
    M m = medium();
    m.*p.first = number(p.a);
    m.*p.second = number(p.b);
    const CompiledScene s = compile_scene(filled(m));
    ASSERT_EQ(s.media.size(), 2u) << p.name;
    EXPECT_FLOAT_EQ(table_at(s, s.media[1].sigma_t, 500), 4) << p.name;
    EXPECT_FLOAT_EQ(table_at(s, s.media[1].sigma_s, 500), 3) << p.name;
    EXPECT_FLOAT_EQ(s.media[1].mean_free_path, 0.25f) << p.name;
    EXPECT_EQ(s.surfaces[0].medium_inside, 1u);
    EXPECT_EQ(s.surfaces[0].medium_outside, 0u);
    EXPECT_TRUE(s.features.media);
    EXPECT_FALSE(s.features.chromatic_media);
    EXPECT_EQ(s.media[1].flags, MEDIUM_ISOTROPIC);
    EXPECT_EQ(table_at(s, s.media[0].sigma_t, 500), 0);
  }
}

TEST(CompiledMedium, ConvertsUnits) {
  MediumDescription m = medium();
  m.sigma_t = number(10.4);
  m.albedo = number(0.94);
  m.unit = LengthUnit::Millimetre;
  SceneDescription d = filled(m);
  d.scene_unit = LengthUnit::Centimetre;  // 10.4 per mm = 104 per cm
  CompiledScene s = compile_scene(d);
  EXPECT_FLOAT_EQ(table_at(s, s.media[1].sigma_t, 500), 104);
  EXPECT_FLOAT_EQ(table_at(s, s.media[1].sigma_s, 500), 104 * 0.94f);
  EXPECT_TRUE(s.warnings.empty() || s.warnings[0].find("unit") == std::string::npos);
  d.scene_unit = LengthUnit::None;
  s = compile_scene(d);
  EXPECT_FLOAT_EQ(table_at(s, s.media[1].sigma_t, 500), 10.4f);
  EXPECT_NE(s.warnings.at(0).find("scene unit"), std::string::npos);
}

/// Two media in layers: vacuum | `outer` boundary | medium 1 | index-matched boundary | medium 2.
SceneDescription layers(MaterialKind outer) {
  MediumDescription m = medium();
  m.sigma_t = number(1);
  m.albedo = number(0.5);
  const MediumPtr first = share(m), second = share(m);
  SurfaceDescription skin = sphere(std::make_shared<const MaterialDescription>(material(outer)));
  SurfaceDescription within = sphere(std::make_shared<const MaterialDescription>(material(MaterialKind::Interface)));
  within.transform = scale({0.5, 0.5, 0.5});
  skin.inside = within.outside = first;
  within.inside = second;
  return scene_of({skin, within});
}

std::vector<bool> sealed(const SceneDescription& d) {
  const CompiledScene s = compile_scene(d);
  std::vector<bool> flags;
  for (const layout::Medium& m : s.media) flags.push_back((m.flags & MEDIUM_SEALED) != 0);
  return flags;
}

TEST(CompiledMedium, IsSealedWithAllThatLightReachesStraightFromIt) {
  SceneDescription d = layers(MaterialKind::Dielectric);
  EXPECT_EQ(sealed(d), (std::vector{false, true, true}));
  EXPECT_EQ(sealed(layers(MaterialKind::Interface)), (std::vector{false, false, false}));
  // A lamp in the inner layer shines into both.
  SurfaceDescription lamp = sphere(lambertian());
  lamp.transform = scale({0.1, 0.1, 0.1});
  lamp.outside = d.surfaces[1].inside;
  lamp.emit = number(1);
  d.surfaces.push_back(lamp);
  EXPECT_EQ(sealed(d), (std::vector{false, false, false}));
  // So would one that the camera in the inner layer sees.
  d = layers(MaterialKind::Dielectric);
  d.camera.medium = d.surfaces[1].inside;
  EXPECT_EQ(sealed(d), (std::vector{false, false, false}));
}

TEST(CompiledMedium, RefusesWhatIsNoMediumAndSaysWhere) {
  MediumDescription m = medium();
  m.sigma_t = sampled({280, 500, 501, 780}, {2, 2, 0.5, 2});
  m.sigma_s = number(1);
  EXPECT_NE(error_of(filled(m)).find("/media/0"), std::string::npos);
  EXPECT_NE(error_of(filled(m)).find("sigma_s (1.000000) is greater than sigma_t"), std::string::npos);
  EXPECT_NE(error_of(filled(m)).find("at 501 nm"), std::string::npos);
  m.sigma_t = number(-1);
  EXPECT_NE(error_of(filled(m)).find("sigma_t is negative"), std::string::npos);
  m.sigma_t = number(INFINITY);
  EXPECT_NE(error_of(filled(m)).find("finite"), std::string::npos);
  m.sigma_t = nullptr;
  EXPECT_NE(error_of(filled(m)).find("exactly two"), std::string::npos);
  m.sigma_t = number(1), m.sigma_s = nullptr, m.sigma_a = number(2);
  EXPECT_NE(error_of(filled(m)).find("sigma_a is greater"), std::string::npos);
  m = medium();
  m.sigma_s = number(1), m.albedo = number(0);
  EXPECT_NE(error_of(filled(m)).find("undetermined"), std::string::npos);
  m.sigma_s = nullptr, m.sigma_a = number(1), m.albedo = number(1);
  EXPECT_NE(error_of(filled(m)).find("undetermined"), std::string::npos);
  m.albedo = number(0.5), m.g = number(1);
  EXPECT_NE(error_of(filled(m)).find("(-1, 1)"), std::string::npos);
}

TEST(CompiledMedium, IsCheckedEvenWhereNoSurfaceUsesIt) {
  MediumDescription m = medium();
  m.sigma_t = number(1), m.sigma_s = number(2);
  SceneDescription d = scene_of({quad(lambertian())});
  d.media.push_back(share(m));
  EXPECT_NE(error_of(d).find("greater than sigma_t"), std::string::npos);
  m.sigma_s = number(1);
  d.media = {share(m)};
  const CompiledScene s = compile_scene(d);
  EXPECT_EQ(s.media.size(), 1u);
  EXPECT_FALSE(s.features.media);
}

TEST(CompiledMedium, IsChromaticWhenExtinctionOrPhaseVary) {
  MediumDescription m = medium();
  m.sigma_t = number(1);
  m.albedo = color({0.9, 0.2, 0.1});
  EXPECT_FALSE(compile_scene(filled(m)).features.chromatic_media);
  m.g = sampled({280, 780}, {0.5, 0.6});
  EXPECT_TRUE(compile_scene(filled(m)).features.chromatic_media);
  m.g = nullptr;
  m.sigma_t = sampled({280, 780}, {1, 1.00001});
  const CompiledScene s = compile_scene(filled(m));
  EXPECT_TRUE(s.features.chromatic_media);
  EXPECT_TRUE(s.media[1].flags & MEDIUM_CHROMATIC);
}

// The first surface along the view names the camera's medium by the side that it shows.
TEST(CompiledCameraMedium, IsFoundFromTheScene) {
  MediumDescription m = medium();
  m.sigma_t = number(1), m.albedo = number(0.5);
  SceneDescription d = filled(m);
  EXPECT_EQ(compile_scene(d).header.camera.medium, 0u);  // outside
  d.camera.transform = {};
  EXPECT_EQ(compile_scene(d).header.camera.medium, 1u);  // inside
  d.surfaces[0].flip = true;
  EXPECT_EQ(compile_scene(d).header.camera.medium, 0u);
  d.surfaces[0].flip = false;
  d.surfaces[0].transform = scale({1, 1, 2});
  EXPECT_EQ(compile_scene(d).header.camera.medium, 1u);
  d.camera.transform = translate({0, 0, -5});  // looks away: nothing in view
  EXPECT_EQ(compile_scene(d).header.camera.medium, 0u);
  d.camera.medium = d.surfaces[0].inside;
  EXPECT_EQ(compile_scene(d).header.camera.medium, 1u);
  d = scene_of({quad(lambertian())});
  d.surfaces[0].outside = share(m);
  EXPECT_EQ(compile_scene(d).header.camera.medium, 1u);
  d.surfaces[0] = mesh(lambertian(), one_triangle(), translate({-0.1, -0.1, 0}));
  d.surfaces[0].inside = share(m);
  EXPECT_EQ(compile_scene(d).header.camera.medium, 0u);
  d.surfaces[0].flip = true;
  EXPECT_EQ(compile_scene(d).header.camera.medium, 1u);
}

}  // namespace
}  // namespace stokes::test
