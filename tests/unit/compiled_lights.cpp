// Lights: who is one, how often each is chosen, the alias table, backgrounds, environments, powers, the film's unit.
#include <cmath>
#include <numbers>

#include "compiled/alias_table.h"
#include "compiled_scenes.h"
#include "spectral/tabulate.h"

namespace stokes::test {
namespace {

constexpr double kPi = std::numbers::pi;

double sum_of_probabilities(const CompiledScene& s) {
  double sum = 0;
  for (const layout::Light& l : s.lights) sum += l.probability;
  return sum;
}

TEST(AliasTable, DrawsEachIndexByItsWeight) {
  const std::vector<double> weights{5, 0, 1, 3, 0.25, 7};
  const auto table = compiled::make_alias_table(weights);
  std::vector<double> drawn(weights.size(), 0.0);
  for (std::size_t i = 0; i < table.size(); i++) {
    drawn[i] += table[i].threshold / 6;
    drawn[table[i].alias] += (1 - table[i].threshold) / 6;
  }
  for (std::size_t i = 0; i < weights.size(); i++) {
    EXPECT_NEAR(drawn[i], weights[i] / 16.25, 1e-12);
    EXPECT_NEAR(table[i].probability, weights[i] / 16.25, 1e-12);
  }
}

TEST(CompiledLights, AreChosenByPowerOverAllWavelengths) {
  SurfaceDescription glowing = mesh(lambertian(), one_triangle(), translate({5, 0, 0}));
  glowing.emit = box(300, 400, 1);
  const CompiledScene s = compile_scene(scene_of({quad(light(box(300, 400, 2)), {}, 2, 1), sphere(light(box(500, 550, 1)), translate({0, 3, 0}), 0.5),
                                                  sphere(light(constant(0.1)), scale({1, 1, 2})), glowing, quad(lambertian()), quad(light(number(0)))}));
  ASSERT_EQ(s.lights.size(), 4u);
  const double ellipsoid = s.ellipsoids[0].area;
  const double powers[] = {2 * 200, kPi * 50, ellipsoid * 50, 0.5 * 100};
  const double total = powers[0] + powers[1] + powers[2] + powers[3];
  for (std::size_t i = 0; i < 4; i++) EXPECT_NEAR(s.lights[i].probability, powers[i] / total, 1e-5) << i;
  EXPECT_NEAR(sum_of_probabilities(s), 1, 1e-6);
  EXPECT_EQ(s.lights[0].type, layout::uint(layout::LIGHT_QUAD));
  EXPECT_EQ(s.lights[1].type, layout::uint(layout::LIGHT_SPHERE));
  EXPECT_EQ(s.lights[2].type, layout::uint(layout::LIGHT_ELLIPSOID));
  EXPECT_EQ(s.lights[3].type, layout::uint(layout::LIGHT_TRIANGLE));
  EXPECT_EQ(s.quads[0].light, 0u);
  EXPECT_EQ(s.quads[1].light, STOKES_NONE);
  EXPECT_EQ(s.quads[2].light, STOKES_NONE);  // black light
  EXPECT_EQ(s.triangles[0].light, 3u);
  EXPECT_EQ(s.header.light_count, 4u);
  EXPECT_EQ(s.materials[s.surfaces[0].material].type, layout::uint(layout::MATERIAL_BLACK));
}

TEST(CompiledLights, BackgroundUsesTheScenesDisc) {
  SceneDescription d = scene_of({quad(light(constant(1)), {}, 2, 2)});
  d.background.emission = constant(0.25);
  const CompiledScene s = compile_scene(d);
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(s.header.background_light, 1u);
  EXPECT_NE(s.header.background, STOKES_NONE);
  EXPECT_TRUE(s.features.background);
  const double area = 4, background = 0.25 * 4 * kPi * 2;  // the radius is sqrt(2)
  EXPECT_NEAR(s.lights[1].probability, background / (area + background), 1e-5);
  d.background.emission = number(0);
  EXPECT_EQ(compile_scene(d).header.background, STOKES_NONE);
}

TEST(CompiledLights, NoneIsAWarning) {
  const CompiledScene s = compile_scene(scene_of({quad(lambertian())}));
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_NE(s.warnings[0].find("no light"), std::string::npos);
  EXPECT_GT(s.header.film_quantum, 0);
}

TEST(CompiledLights, PowerIsRadiantExitance) {
  MaterialDescription m = material(MaterialKind::DiffuseLight);
  m.emit = box(350, 380, 7);
  m.power = 12;
  const CompiledScene s = compile_scene(scene_of({quad(share(m))}));
  // 12 = pi * L * 30 nm
  EXPECT_NEAR(table_at(s, s.surfaces[0].emission, 360), 12 / (kPi * 30), 1e-6);
  EXPECT_EQ(table_at(s, s.surfaces[0].emission, 390), 0);
  m.emit = constant(0);
  EXPECT_NE(error_of(scene_of({quad(share(m))})).find("power"), std::string::npos);
}

TEST(CompiledLights, BlendsOfLightsAddUp) {
  MaterialDescription m = material(MaterialKind::Blend);
  m.a = light(constant(1)), m.b = lambertian();
  m.amount = 0.25;
  const CompiledScene s = compile_scene(scene_of({quad(share(m))}));
  EXPECT_FLOAT_EQ(table_at(s, s.surfaces[0].emission, 400), 0.75f);
  EXPECT_TRUE(s.features.blends);
}

TEST(CompiledLights, FilmQuantumIsAPowerOfTwoBelowTheBrightest) {
  for (const double radiance : {1e-6, 1.0, 1e5}) {
    const CompiledScene s = compile_scene(scene_of({quad(light(constant(radiance)))}));
    int exponent = 0;
    EXPECT_EQ(std::frexp(s.header.film_quantum, &exponent), 0.5f);
    const double range = std::ldexp(s.header.film_quantum, 40) / radiance;
    EXPECT_GE(range, 1);
    EXPECT_LE(range, 4);
  }
}

TEST(CompiledEnvironment, IsSampledByItsPower) {
  ImagePixels image;
  image.width = 8, image.height = 4;
  image.rgb.assign(3 * 32, 0.0f);
  for (int k = 0; k < 3; k++) image.rgb[std::size_t(3 * (2 * 8 + 5) + k)] = 2;  // one bright texel, row 2, column 5
  SceneDescription d = scene_of({quad(lambertian())});
  d.background.environment = std::make_shared<const ImagePixels>(image);
  d.background.rotate = 90;
  d.background.scale = 3;
  const CompiledScene s = compile_scene(d);
  EXPECT_TRUE(s.features.environment);
  EXPECT_EQ(s.header.has_environment, 1u);
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(s.header.background_light, 0u);
  EXPECT_FLOAT_EQ(s.lights[0].probability, 1);
  EXPECT_FLOAT_EQ(s.environment.scale, 3);
  ASSERT_EQ(s.environment_cdf.size(), 5u + 4 * 9);
  EXPECT_FLOAT_EQ(s.environment_cdf[4], 1);
  EXPECT_EQ(s.environment_cdf[1], 0);  // the top row is neither lit nor beside one that is
  const float* row = &s.environment_cdf[5 + 2 * 9];
  EXPECT_EQ(row[0], 0);
  EXPECT_EQ(row[8], 1);
  EXPECT_GT(row[6] - row[5], 0.6f);  // mostly the bright texel, and its neighbours for the bilinear lookup
  EXPECT_GT(row[5] - row[4], 0);
  EXPECT_EQ(row[4], 0);
  // The texel is upsampled white: the constant sigmoid with the scale, times D65.
  const float* texel = &s.texels[s.environment.image_offset + 4 * (2 * 8 + 5)];
  EXPECT_FLOAT_EQ(texel[3], 4);
  EXPECT_NEAR(sigmoid_value({texel[0], texel[1], texel[2]}, 550), 0.5, 1e-3);
  EXPECT_NEAR(table_at(s, s.environment.illuminant, 560), d65(560), 1e-5);
  // rotate 90 about +y takes the image's +x to the world's -z: the world's -z comes back to +x.
  EXPECT_NEAR(s.environment.to_local[2], -1, 1e-6);
}

}  // namespace
}  // namespace stokes::test
