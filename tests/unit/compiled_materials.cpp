// Materials, textures and RGB mode: defaults, flags, features, tables stored once.
#include <algorithm>
#include <cmath>
#include <random>

#include "compiled/spectra.h"
#include "compiled_scenes.h"

namespace stokes::test {
namespace {

const layout::Material& only_material(const CompiledScene& s) { return s.materials.at(s.surfaces.at(0).material); }
SceneDescription with(MaterialDescription m) { return scene_of({quad(share(std::move(m)))}); }

TEST(CompiledMaterial, HasItsDefaults) {
  CompiledScene s = compile_scene(with(material(MaterialKind::Lambertian)));
  EXPECT_FLOAT_EQ(table_at(s, only_material(s).albedo, 500), 0.5f);
  s = compile_scene(with(material(MaterialKind::Dielectric)));
  EXPECT_FLOAT_EQ(table_at(s, only_material(s).albedo, 500), 1);
  EXPECT_FLOAT_EQ(table_at(s, only_material(s).eta, 500), 1.5f);
  EXPECT_TRUE(s.features.smooth_dielectric);
  EXPECT_FALSE(s.features.rough_dielectric || s.features.dispersion);
  s = compile_scene(with(material(MaterialKind::Interface)));
  EXPECT_TRUE(s.features.interfaces);
  EXPECT_TRUE(s.surfaces[0].flags & SURFACE_INTERFACE);
  MaterialDescription metal = material(MaterialKind::Metal);
  metal.roughness = 0.3;
  s = compile_scene(with(metal));
  EXPECT_FLOAT_EQ(only_material(s).parameter, 0.3f);
  EXPECT_TRUE(s.features.metal);
}

TEST(CompiledMaterial, DispersesOnlyWhenTheIndexVaries) {
  MaterialDescription m = material(MaterialKind::Dielectric);
  Spectrum cauchy;
  cauchy.kind = SpectrumKind::Cauchy;
  cauchy.a = 1.5, cauchy.b = 0;
  m.ior = std::make_shared<const Spectrum>(cauchy);
  EXPECT_FALSE(compile_scene(with(m)).features.dispersion);
  cauchy.b = 0.004;
  m.ior = std::make_shared<const Spectrum>(cauchy);
  m.alpha = 0.1;
  CompiledScene s = compile_scene(with(m));
  EXPECT_TRUE(s.features.dispersion && s.features.rough_dielectric);
  EXPECT_TRUE(only_material(s).flags & MATERIAL_DISPERSIVE);
  SceneDescription d = with(m);
  d.integrator.mode = ColorMode::Rgb;
  EXPECT_FALSE(compile_scene(d).features.dispersion);
  m.ior = number(0);
  EXPECT_NE(error_of(with(m)).find("positive"), std::string::npos);
}

TEST(CompiledMaterial, IsStoredOnceAndSoIsItsTable) {
  const MaterialPtr m = lambertian(0.25);
  const CompiledScene s = compile_scene(scene_of({quad(m), quad(m), quad(lambertian(0.25))}));
  EXPECT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0].albedo, s.materials[1].albedo);
  EXPECT_EQ(s.spectra.size(), 2u * STOKES_SPECTRUM_STRIDE);  // vacuum's zero, and 0.25
}

TEST(CompiledMaterial, BlendsNestAndKeepTheirAmounts) {
  MaterialDescription inner = material(MaterialKind::Blend);
  inner.a = lambertian(0.1), inner.b = lambertian(0.2), inner.amount = 0.75;
  MaterialDescription outer = material(MaterialKind::Blend);
  outer.a = share(inner), outer.b = lambertian(0.3);
  TextureDescription fresnel;
  fresnel.kind = TextureKind::Fresnel;
  fresnel.parameter = 1.4;
  outer.amount_texture = std::make_shared<const TextureDescription>(fresnel);
  const CompiledScene s = compile_scene(with(outer));
  const layout::Material& m = only_material(s);
  ASSERT_EQ(m.type, layout::uint(layout::MATERIAL_BLEND));
  EXPECT_EQ(m.amount_texture, 0u);
  EXPECT_FLOAT_EQ(s.textures[0].parameter, 1.4f);
  EXPECT_FLOAT_EQ(s.materials[m.child_a].amount, 0.75f);
  EXPECT_EQ(s.materials[m.child_a].amount_texture, STOKES_NONE);
  EXPECT_FLOAT_EQ(table_at(s, s.materials[m.child_b].albedo, 400), 0.3f);
  inner.amount = 1.5;
  EXPECT_NE(error_of(with(inner)).find("[0, 1]"), std::string::npos);
}

TextureDescription checker(SpectrumPtr even, SpectrumPtr odd) {
  TextureDescription t;
  t.kind = TextureKind::Checker;
  t.a.spectrum = std::move(even), t.b.spectrum = std::move(odd);
  t.scale = 0.5;
  t.transform = translate({1, 2, 3}) * scale({2, 2, 2});
  t.pointer = "/materials/0/albedo";
  return t;
}

TEST(CompiledTexture, ChecksTransformsAndNests) {
  TextureDescription outer = checker(nullptr, number(0.1));
  outer.a.texture = std::make_shared<const TextureDescription>(checker(number(0.2), number(0.3)));
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.texture = std::make_shared<const TextureDescription>(outer);
  const CompiledScene s = compile_scene(with(m));
  EXPECT_TRUE(s.features.textures);
  ASSERT_TRUE(only_material(s).albedo & STOKES_TEXTURE_BIT);
  const layout::Texture& t = s.textures.at(only_material(s).albedo & ~STOKES_TEXTURE_BIT);
  EXPECT_FLOAT_EQ(t.to_texture[3], -0.5f);
  EXPECT_FLOAT_EQ(t.to_texture[0], 0.5f);
  ASSERT_TRUE(t.a & STOKES_TEXTURE_BIT);
  EXPECT_FLOAT_EQ(table_at(s, s.textures.at(t.a & ~STOKES_TEXTURE_BIT).b, 500), 0.3f);
}

TEST(CompiledTexture, ImagesAreUpsampledAndMasksAreNumbers) {
  auto image = std::make_shared<ImagePixels>();
  image->width = 2, image->height = 1;
  image->rgb = {0.8f, 0.2f, 0.1f, 0.3f, 0.6f, 0.9f};
  TextureDescription t;
  t.kind = TextureKind::Image;
  t.image = image;
  t.clamp = true;
  const auto shared = std::make_shared<const TextureDescription>(t);
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.texture = shared;
  MaterialDescription painted = material(MaterialKind::Blend);
  painted.a = share(m), painted.b = lambertian();
  painted.amount_texture = shared;
  const CompiledScene s = compile_scene(with(painted));
  ASSERT_EQ(s.textures.size(), 2u);
  EXPECT_EQ(s.texels.size(), 2u * 4 + 2);
  const layout::Texture& colors = s.textures[s.materials[only_material(s).child_a].albedo & ~STOKES_TEXTURE_BIT];
  const layout::Texture& mask = s.textures[only_material(s).amount_texture];
  EXPECT_EQ(colors.flags, TEXTURE_WRAP_CLAMP);
  EXPECT_EQ(mask.flags, TEXTURE_WRAP_CLAMP | TEXTURE_SCALAR_IMAGE);
  EXPECT_FLOAT_EQ(s.texels[mask.image_offset + 1], 0.6f);
  // The texel's spectrum under D65 is the pixel's colour.
  for (int pixel = 0; pixel < 2; pixel++) {
    const float* p = &s.texels[colors.image_offset + 4 * std::size_t(pixel)];
    SpectrumTable table;
    for (int i = 0; i < 1000; i++) table[std::size_t(i)] = float(p[3] * sigmoid_value({p[0], p[1], p[2]}, 280 + i / 2 + i % 2));
    const Vec3d rgb = xyz_to_rgb(reflectance_xyz(table));
    for (int k = 0; k < 3; k++) EXPECT_NEAR(rgb[k], image->rgb[std::size_t(3 * pixel + k)], 2e-3);
  }
}

// Images of very many colours are interpolated: each texel must still give its pixel's colour, bright, dark and saturated alike.
TEST(CompiledTexture, ImagesOfManyColorsKeepThem) {
  auto image = std::make_shared<ImagePixels>();
  image->width = 200, image->height = 150;
  std::mt19937 random(3);
  for (int i = 0; i < 200 * 150; i++) {
    const double level = i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 0.05 : 1;
    for (int k = 0; k < 3; k++) image->rgb.push_back(float(level * std::pow(double(random()) / 4294967295.0, 1 + i % 2)));
  }
  TextureDescription t;
  t.kind = TextureKind::Image;
  t.image = image;
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.texture = std::make_shared<const TextureDescription>(t);
  const CompiledScene s = compile_scene(with(m));
  for (std::size_t pixel = 0; pixel < 30000; pixel += 97) {
    const float* p = &s.texels[4 * pixel];
    SpectrumTable table;
    for (int i = 0; i < 1000; i++) table[std::size_t(i)] = float(p[3] * sigmoid_value({p[0], p[1], p[2]}, 280 + i / 2 + i % 2));
    const Vec3d rgb = xyz_to_rgb(reflectance_xyz(table));
    const double peak = std::max({image->rgb[3 * pixel], image->rgb[3 * pixel + 1], image->rgb[3 * pixel + 2]});
    for (int k = 0; k < 3; k++) EXPECT_NEAR(rgb[k], image->rgb[3 * pixel + std::size_t(k)], 5e-4 + 0.015 * peak) << pixel;
  }
}

TEST(CompiledTexture, VertexMasksHaveAFloatForEveryVertexOfTheScene) {
  MeshData a = one_triangle(), b = one_triangle();
  b.positions.insert(b.positions.begin(), {9, 9, 9});  // a vertex that no triangle uses
  b.triangles = {{1, 2, 3}};
  b.masks = {{"lips", {9, 0.1f, 0.2f, 0.3f}}};
  TextureDescription t;
  t.kind = TextureKind::VertexMask;
  t.mask_name = "lips";
  t.pointer = "/materials/0/mask";
  MaterialDescription m = material(MaterialKind::Blend);
  m.a = lambertian(), m.b = lambertian();
  m.amount_texture = std::make_shared<const TextureDescription>(t);
  const MaterialPtr painted = share(m);
  const CompiledScene s = compile_scene(scene_of({mesh(lambertian(), a), mesh(painted, b)}));
  ASSERT_EQ(s.positions.size(), 6u);
  ASSERT_EQ(s.texels.size(), 6u);
  const layout::Triangle& triangle = s.triangles[1];
  EXPECT_FLOAT_EQ(s.texels[s.textures[0].image_offset + triangle.v0], 0.1f);
  EXPECT_FLOAT_EQ(s.texels[s.textures[0].image_offset + triangle.v2], 0.3f);
  EXPECT_NE(error_of(scene_of({mesh(painted, a)})).find("lips"), std::string::npos);
}

TEST(CompiledTexture, ANumberIsNoColor) {
  TextureDescription t;
  t.kind = TextureKind::Fresnel;
  t.pointer = "/materials/0/albedo";
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.texture = std::make_shared<const TextureDescription>(t);
  EXPECT_NE(error_of(with(m)).find("number"), std::string::npos);
}

TEST(CompiledRgb, TablesAreThreeNumbers) {
  MaterialDescription m = material(MaterialKind::Lambertian);
  m.albedo.spectrum = color({0.7, 0.5, 0.2});
  SceneDescription d = with(m);
  d.surfaces.push_back(quad(light(color({4, 5, 6}))));
  d.integrator.mode = ColorMode::Rgb;
  const CompiledScene s = compile_scene(d);
  EXPECT_TRUE(s.features.rgb);
  EXPECT_EQ(s.wavelengths_per_path, 3);
  const float* albedo = &s.spectra[only_material(s).albedo * STOKES_RGB_STRIDE];
  EXPECT_NEAR(albedo[0], 0.7, 1e-4);
  EXPECT_NEAR(albedo[2], 0.2, 1e-4);
  const float* emission = &s.spectra[s.surfaces[1].emission * STOKES_RGB_STRIDE];
  EXPECT_NEAR(emission[1], 5, 1e-3);
  EXPECT_EQ(s.lights.size(), 1u);
  CompileOptions options;
  options.spectral_bins = 10, options.spectral_begin = 400, options.spectral_end = 700;
  EXPECT_NE(error_of(d, options).find("rgb mode"), std::string::npos);
}

TEST(CompiledHeader, FollowsIntegratorAndOptions) {
  SceneDescription d = scene_of({quad(light(number(1)))});
  d.integrator.kind = IntegratorKind::Nee;
  d.integrator.max_bounces = 7;
  d.integrator.russian_roulette = std::nullopt;
  d.integrator.wavelengths_per_path = 8;
  CompileOptions options;
  options.film_channels = FILM_ALBEDO | FILM_DEPTH | FILM_FLUORESCENCE;
  options.spectral_bins = 31, options.spectral_begin = 400, options.spectral_end = 710;
  const CompiledScene s = compile_scene(d, options);
  EXPECT_EQ(s.header.integrator, layout::uint(layout::INTEGRATOR_NEE));
  EXPECT_EQ(s.header.max_bounces, 7u);
  EXPECT_EQ(s.header.russian_roulette, STOKES_NONE);
  EXPECT_EQ(s.wavelengths_per_path, 8);
  EXPECT_EQ(s.header.film_stride, 12u + 3 + 1 + 4 + 31);
  EXPECT_EQ(s.camera_knots.size(), STOKES_CAMERA_KNOTS + 1u);
  EXPECT_EQ(s.sensor.size(), 4000u);
  d.integrator.wavelengths_per_path = 3;
  EXPECT_NE(error_of(d).find("wavelengths per path"), std::string::npos);
}

}  // namespace
}  // namespace stokes::test
