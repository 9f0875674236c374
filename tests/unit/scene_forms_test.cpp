// Every form of the format is read as the manual says: defaults, spellings, values.
#include <cmath>

#include "unit/scene_support.h"

namespace stokes {
namespace {

void expect_near(Vec3d a, Vec3d b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

Affine transform(const std::string& json) {
  return surface(R"({"type": "sphere", "material": {"type": "interface"}, "transform": )" + json + "}").transform;
}

TEST(SceneForms, DefaultsOfAnEmptyScene) {
  const SceneDescription s = parse("{\"camera\": {}}");
  EXPECT_EQ(s.camera.vfov, 90);
  EXPECT_EQ(s.camera.fdist, 1);
  EXPECT_EQ(s.camera.aperture, 0);
  EXPECT_FALSE(s.camera.orthographic);
  EXPECT_FALSE(s.camera.medium.has_value());
  EXPECT_EQ(s.integrator.kind, IntegratorKind::Mis);
  EXPECT_EQ(s.integrator.max_bounces, 64);
  EXPECT_EQ(s.integrator.wavelengths_per_path, 4);
  EXPECT_EQ(s.integrator.mode, ColorMode::Spectral);
  EXPECT_EQ(s.background.emission, nullptr);
  EXPECT_EQ(s.scene_unit, LengthUnit::None);
  EXPECT_TRUE(s.surfaces.empty());
}

TEST(SceneForms, Camera) {
  const CameraDescription c =
      parse(
          R"({"camera": {"transform": {"from": [0, 0, 5], "to": [0, 0, 0]}, "vfov": 30, "fdist": 800, "aperture": 0.5, "resolution": [640, 480.0], "medium": "vacuum"}})")
          .camera;
  EXPECT_EQ(c.vfov, 30);
  EXPECT_EQ(c.fdist, 800);
  EXPECT_EQ(c.aperture, 0.5);
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height_pixels, 480);
  ASSERT_TRUE(c.medium.has_value());
  EXPECT_EQ(*c.medium, nullptr);
  const CameraDescription o = parse(R"({"camera": {"type": "orthographic", "height": 3}})").camera;
  EXPECT_TRUE(o.orthographic);
  EXPECT_EQ(o.height, 3);
}

TEST(SceneForms, CameraMediumByName) {
  const SceneDescription s =
      parse(R"({"camera": {"medium": "water"}, "media": [{"type": "homogeneous", "name": "water", "sigma_a": 1, "sigma_s": 2}]})");
  EXPECT_EQ(*s.camera.medium, s.media.at(0));
}

TEST(SceneForms, TransformCommands) {
  expect_near(transform(R"({"translate": [1, 2, 3]})").point({1, 1, 1}), {2, 3, 4});
  expect_near(transform(R"({"scale": 2})").point({1, 1, 1}), {2, 2, 2});
  expect_near(transform(R"({"scale": [1, -2, 3]})").point({1, 1, 1}), {1, -2, 3});
  expect_near(transform(R"({"rotate": [90, 0, 0, 2]})").point({1, 0, 0}), {0, 1, 0});
  expect_near(transform(R"({"rotate": [-450, 1, 0, 0]})").point({0, 0, 1}), {0, 1, 0});
  expect_near(transform(R"({"rotate": [30, 0, 1, 0]})").point({0, 0, 1}), {0.5, 0, std::sqrt(0.75)});
  expect_near(transform(R"({"angle": 90, "axis": [0, 1, 0]})").point({0, 0, 1}), {1, 0, 0});
  expect_near(transform(R"({"o": [1, 0, 0], "y": [0, 0, -1], "z": [0, 1, 0]})").point({1, 1, 0}), {2, 0, -1});
  expect_near(transform(R"({"matrix": [0, 2, 0, 5,  1, 0, 0, 6,  0, 0, 1, 7,  0, 0, 0, 1]})").point({1, 2, 3}), {9, 7, 10});
}

TEST(SceneForms, QuarterTurnsAreExact) {
  EXPECT_EQ(transform(R"({"rotate": [90, 1, 0, 0]})").m, (std::array<double, 12>{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}));
}

TEST(SceneForms, LookAtLooksDownItsMinusZ) {
  const Affine t = transform(R"({"from": [5, 0, 0], "at": [0, 0, 0], "up": [0, 0, 1]})");
  expect_near(t.vector({0, 0, -1}), {-1, 0, 0});
  expect_near(t.vector({0, 1, 0}), {0, 0, 1});
  expect_near(t.vector({1, 0, 0}), {0, 1, 0});
  expect_near(t.translation(), {5, 0, 0});
  expect_near(transform(R"({"from": [0, 0, 2]})").translation(), {0, 0, 2});
}

TEST(SceneForms, TransformArraysApplyTheFirstEntryFirst) {
  expect_near(transform(R"([{"translate": [1, 0, 0]}, {"scale": 2}])").point({}), {2, 0, 0});
  expect_near(transform(R"([{"scale": 2}, {"translate": [1, 0, 0]}])").point({}), {1, 0, 0});
  expect_near(transform("[]").point({1, 2, 3}), {1, 2, 3});
}

TEST(SceneForms, GroupsNestTransforms) {
  const SceneDescription s = parse(with(R"("surfaces": [{"type": "group", "transform": {"scale": 2}, "children": [
    {"type": "group", "transform": {"translate": [1, 0, 0]}, "surfaces": [{"type": "sphere", "material": {"type": "interface"}, "transform": {"translate": [0, 1, 0]}}]},
    {"type": "quad", "material": {"type": "interface"}}]}])"));
  ASSERT_EQ(s.surfaces.size(), 2u);
  expect_near(s.surfaces[0].transform.point({}), {2, 2, 0});
  EXPECT_EQ(s.surfaces[0].pointer, "/surfaces/0/children/0/surfaces/0");
  EXPECT_EQ(s.surfaces[1].kind, SurfaceKind::Quad);
}

TEST(SceneForms, AnAccelerationStructureIsAGroup) {
  const SceneDescription s =
      parse(with(R"("surfaces": [{"type": "bbh", "split_method": "sah", "max_leaf_size": 4, "transform": {"scale": 3},
    "children": [{"type": "sphere", "material": {"type": "interface"}, "transform": {"translate": [0, 1, 0]}}]}])"));
  ASSERT_EQ(s.surfaces.size(), 1u);
  expect_near(s.surfaces[0].transform.point({}), {0, 3, 0});
}

TEST(SceneForms, IntegratorNames) {
  const auto kind = [](const std::string& name) { return parse(with("\"integrator\": {\"type\": \"" + name + "\"}")).integrator.kind; };
  for (const char* name :
       {"path tracer mats", "path_tracer_mats", "path tracer volumetric", "path tracer volumetric mats", "fluorescent mats"})
    EXPECT_EQ(kind(name), IntegratorKind::Mats) << name;
  for (const char* name : {"path tracer nee", "path_tracer_nee", "path tracer volumetric nee", "path_tracer_volumetric_nee"})
    EXPECT_EQ(kind(name), IntegratorKind::Nee) << name;
  for (const char* name :
       {"path tracer mis", "path tracer volumetric mis", "volume path tracer mis", "fluorescent mis", "path_tracer_mixture", "path tracer"})
    EXPECT_EQ(kind(name), IntegratorKind::Mis) << name;
  EXPECT_EQ(kind("normals"), IntegratorKind::Normals);
  EXPECT_EQ(kind("ao"), IntegratorKind::Ao);
}

TEST(SceneForms, IntegratorKeys) {
  const IntegratorDescription i =
      parse(
          with(
              R"("integrator": {"type": "path_tracer_mis", "max_bounces": 1, "recursive": false, "russian roulette": false, "power": 1, "wavelengths per path": 8, "mode": "rgb"})"))
          .integrator;
  EXPECT_EQ(i.max_bounces, 1);
  EXPECT_EQ(i.russian_roulette, std::nullopt);
  EXPECT_EQ(i.wavelengths_per_path, 8);
  EXPECT_EQ(i.mode, ColorMode::Rgb);
  EXPECT_EQ(parse(with(R"("integrator": {"russian_roulette": true})")).integrator.russian_roulette, 5);
  EXPECT_EQ(parse(with(R"("integrator": {"russian roulette": 12})")).integrator.russian_roulette, 12);
}

TEST(SceneForms, SamplersFilmAndIgnoredKeys) {
  for (const char* type : {"independent", "stratified", "cmj", "sobol"}) {
    const SceneDescription s = parse(with(
        std::string(
            R"("$schema": "x", "accelerator": {"type": "bbh", "split_method": "sah"}, "film": {"spectral": [300, 400, 10]}, "sampler": {"samples": 9, "seed": 4294967295, "type": ")") +
        type + "\"}"));
    EXPECT_EQ(s.samples, 9);
    EXPECT_EQ(s.seed, 4294967295u);
    EXPECT_EQ(s.spectral_bins->count, 10);
  }
}

TEST(SceneForms, Spectra) {
  EXPECT_EQ(background("0.5").kind, SpectrumKind::Number);
  EXPECT_EQ(background("0.5").value, 0.5);
  EXPECT_EQ(background("[1, 2, 3]").kind, SpectrumKind::Rgb);
  EXPECT_EQ(background("[1, 2, 3]").rgb.z, 3);
  EXPECT_EQ(background(R"({"type": "rgb", "value": [0, 0.5, 1], "uv": 0.25})").uv, 0.25);
  EXPECT_EQ(background(R"({"type": "constant", "value": 2})").kind, SpectrumKind::Constant);
  EXPECT_EQ(background(R"({"type": "constant", "color": 2})").kind, SpectrumKind::Number);
  EXPECT_EQ(background(R"({"type": "constant", "color": [1, 2, 3]})").rgb.y, 2);
  const Spectrum sampled =
      background(R"({"type": "sampled", "wavelengths": [400, 500], "values": [1, 2], "scale": 3, "extrapolate": "hold"})");
  EXPECT_EQ(sampled.kind, SpectrumKind::Sampled);
  EXPECT_EQ(sampled.wavelengths, (std::vector<double>{400, 500}));
  EXPECT_EQ(sampled.scale, 3);
  EXPECT_EQ(sampled.extrapolate, Extrapolate::Hold);
  const Spectrum box = background(R"({"type": "box", "range": [400, 500], "value": 2})");
  EXPECT_EQ(box.a, 400);
  EXPECT_EQ(box.b, 500);
  EXPECT_EQ(box.value, 2);
  const Spectrum gaussian = background(R"({"type": "gaussian", "mean": 550, "stddev": 10, "value": 3})");
  EXPECT_EQ(gaussian.a, 550);
  EXPECT_EQ(gaussian.b, 10);
  EXPECT_EQ(gaussian.value, 3);
  EXPECT_EQ(background(R"({"type": "blackbody", "temperature": 5000})").a, 5000);
  for (const char* name : {"D65", "A", "E"})
    EXPECT_EQ(background(std::string(R"({"type": "illuminant", "name": ")") + name + "\"}").illuminant, name);
  const Spectrum product = background(R"({"type": "product", "of": [{"type": "sum", "of": [1, 2]}, 3]})");
  EXPECT_EQ(product.kind, SpectrumKind::Product);
  EXPECT_EQ(product.of.at(0)->of.at(1)->value, 2);
}

TEST(SceneForms, IndicesOfRefraction) {
  const MaterialDescription bk7 = material(
      R"({"type": "dielectric", "ior": {"type": "sellmeier", "B": [1.03961212, 0.231792344, 1.01046945], "C": [0.00600069867, 0.0200179144, 103.560653]}})");
  EXPECT_EQ(bk7.ior->kind, SpectrumKind::Sellmeier);
  EXPECT_EQ(bk7.ior->sellmeier_c[2], 103.560653);
  const MaterialDescription cauchy = material(R"({"type": "dielectric", "ior": {"type": "cauchy", "A": 1.5, "B": 0.004}})");
  EXPECT_EQ(cauchy.ior->a, 1.5);
  EXPECT_EQ(cauchy.ior->b, 0.004);
}

TEST(SceneForms, NamedThingsAreShared) {
  const SceneDescription s = parse(with(R"("spectra": [{"type": "constant", "value": 0.5, "name": "grey"}],
    "media": [{"type": "homogeneous_hg", "name": "fog", "sigma_t": "grey", "albedo": "grey"}],
    "materials": [{"type": "lambertian", "name": "wall", "albedo": "grey"}],
    "surfaces": [{"type": "quad", "material": "wall", "outside": "air", "inside": "fog"}, {"type": "quad", "material": "wall", "outside": null}])"));
  EXPECT_EQ(s.surfaces[0].material, s.surfaces[1].material);
  EXPECT_EQ(s.surfaces[0].material->albedo.spectrum, s.spectra.at(0));
  EXPECT_EQ(s.surfaces[0].inside, s.media.at(0));
  EXPECT_EQ(s.surfaces[0].outside, nullptr);
}

TEST(SceneForms, Media) {
  const MediumDescription naito =
      medium(R"({"type": "homogeneous", "name": "skin", "sigma_t": 10.4, "albedo": 0.94, "g": 0.9, "unit": "mm"})");
  EXPECT_EQ(naito.sigma_t->value, 10.4);
  EXPECT_EQ(naito.albedo->value, 0.94);
  EXPECT_EQ(naito.g->value, 0.9);
  EXPECT_EQ(naito.unit, LengthUnit::Millimetre);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "sigma_s": 1, "sigma_a": 1})").g, nullptr);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "sigma_s": 1, "sigma_a": 1, "g": 0})").g, nullptr);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "sigma_s": 1, "sigma_a": 1, "phase function": {"type": "hg", "g": -0.5}})").g->value, -0.5);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "sigma_s": 1, "sigma_a": 1, "phase_function": {"type": "isotropic"}})").g, nullptr);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "sigma_s": 1, "sigma_a": 1, "phase function": "isotropic"})").g, nullptr);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "total": 3, "albedo": [0.1, 0.2, 0.3]})").sigma_t->value, 3);
  EXPECT_EQ(medium(R"({"type": "homogeneous", "total": 3})").albedo->value, 0.8);
  EXPECT_TRUE(medium(R"({"type": "vacuum"})").vacuum);
  const MediumDescription dyed = medium(
      R"({"type": "homogeneous", "sigma_s": 0, "sigma_a": 0, "dyes": [{"absorption": 4, "emission": {"type": "gaussian", "mean": 520, "stddev": 20}, "yield": 0.9}]})");
  EXPECT_EQ(dyed.dyes.at(0).absorption->value, 4);
  EXPECT_EQ(dyed.dyes.at(0).yield, 0.9);
}

TEST(SceneForms, AUnitWithoutTheScenesIsWarnedOf) {
  const std::string media = R"("media": [{"type": "homogeneous", "name": "m", "sigma_t": 1, "albedo": 1, "unit": "mm"}])";
  const auto warnings = parse(with(media)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], testing::StartsWith("scene.json:2:83: warning: /media/0/unit: "));
  const SceneDescription s = parse(with("\"scene_unit\": \"cm\", " + media));
  EXPECT_TRUE(s.warnings.empty());
  EXPECT_EQ(s.scene_unit, LengthUnit::Centimetre);
}

TEST(SceneForms, OpaqueMaterials) {
  EXPECT_EQ(material(R"({"type": "lambertian"})").albedo.spectrum->value, 0.5);
  const MaterialDescription metal = material(R"({"type": "metal", "albedo": [0.9, 0.8, 0.7], "roughness": 0.25})");
  EXPECT_EQ(metal.kind, MaterialKind::Metal);
  EXPECT_EQ(metal.roughness, 0.25);
  EXPECT_EQ(material(R"({"type": "metal", "roughness": 3})").roughness, 1);
  const MaterialDescription gold = material(R"({"type": "conductor", "eta": 0.2, "k": 3.9, "alpha": 0.1})");
  EXPECT_EQ(gold.kind, MaterialKind::Conductor);
  EXPECT_EQ(gold.eta->value, 0.2);
  EXPECT_EQ(gold.k->value, 3.9);
  EXPECT_EQ(gold.alpha, 0.1);
  EXPECT_EQ(material(R"({"type": "phong", "exponent": 50})").exponent, 50);
  for (const char* type : {"blinn_phong", "blinn-phong", "blinn phong"})
    EXPECT_EQ(material(std::string(R"({"type": ")") + type + "\"}").kind, MaterialKind::BlinnPhong);
}

TEST(SceneForms, BoundaryMaterials) {
  const MaterialDescription plain = material(R"({"type": "dielectric"})");
  EXPECT_EQ(plain.ior->value, 1.5);
  EXPECT_EQ(plain.alpha, 0);
  EXPECT_TRUE(plain.albedo.empty());
  EXPECT_EQ(material(R"({"type": "dielectric", "alpha": 0.2, "scatter albedo": 0.9})").albedo.spectrum->value, 0.9);
  EXPECT_EQ(material(R"({"type": "interface"})").kind, MaterialKind::Interface);
}

TEST(SceneForms, Lights) {
  EXPECT_EQ(material(R"({"type": "diffuse_light"})").emit->value, 1);
  EXPECT_EQ(material(R"({"type": "diffuse light", "emit": [1, 2, 3]})").emit->rgb.y, 2);
  EXPECT_NE(material(R"({"type": "diffuse_light", "emit": {"type": "checker"}})").emit_texture, nullptr);
  const MaterialDescription lamp = material(R"({"type": "uv_light", "power": 4})");
  EXPECT_EQ(lamp.kind, MaterialKind::DiffuseLight);
  EXPECT_EQ(lamp.emit->kind, SpectrumKind::Gaussian);
  EXPECT_EQ(lamp.emit->a, 365);
  EXPECT_EQ(lamp.emit->b, 10);
  EXPECT_EQ(lamp.power, 4);
}

TEST(SceneForms, Fluorescence) {
  const MaterialDescription one = material(
      R"({"type": "diffuse_fluorescent", "absorption": {"type": "box", "range": [300, 400]}, "emission": {"type": "gaussian", "mean": 500, "stddev": 20}, "yield_type": "energy", "stokes": true})");
  EXPECT_EQ(one.albedo.spectrum->value, 0);
  ASSERT_EQ(one.dyes.size(), 1u);
  EXPECT_FALSE(one.dyes[0].photon_yield);
  EXPECT_TRUE(one.dyes[0].stokes);
  EXPECT_EQ(one.dyes[0].yield, 1);
  EXPECT_EQ(one.dyes[0].concentration, 1);
  const MaterialDescription two = material(R"({"type": "diffuse fluorescent", "albedo": 0.5, "dyes": [
    {"absorption": 0.1, "emission": {"type": "gaussian", "mean": 500, "stddev": 20}, "concentration": 0.5},
    {"absorption": 0.2, "emission": {"type": "gaussian", "mean": 600, "stddev": 20}, "yield": 0.25}]})");
  ASSERT_EQ(two.dyes.size(), 2u);
  EXPECT_EQ(two.dyes[0].concentration, 0.5);
  EXPECT_TRUE(two.dyes[1].photon_yield);
  EXPECT_EQ(two.dyes[1].yield, 0.25);
}

TEST(SceneForms, Blends) {
  const MaterialDescription half = material(R"({"type": "blend", "a": {"type": "metal"}, "b": {"type": "lambertian"}, "amount": 0.25})");
  EXPECT_EQ(half.a->kind, MaterialKind::Metal);
  EXPECT_EQ(half.b->kind, MaterialKind::Lambertian);
  EXPECT_EQ(half.amount, 0.25);
  const MaterialDescription fresnel =
      material(R"({"type": "blend", "a": {"type": "metal"}, "b": {"type": "lambertian"}, "amount": {"type": "fresnel", "ior": 2}})");
  EXPECT_EQ(fresnel.amount_texture->kind, TextureKind::Fresnel);
  EXPECT_EQ(fresnel.amount_texture->parameter, 2);
  const MaterialDescription old =
      material(R"({"type": "fresnel_blend", "ior": 1.2, "refr": {"type": "lambertian"}, "refl": {"type": "metal"}})");
  EXPECT_EQ(old.a->kind, MaterialKind::Lambertian);
  EXPECT_EQ(old.b->kind, MaterialKind::Metal);
  EXPECT_EQ(old.amount_texture->parameter, 1.2);
  const MaterialDescription constant = material(
      R"({"type": "fresnel_blend", "ior": {"type": "constant", "color": 1.4}, "refr": {"type": "lambertian"}, "refl": {"type": "metal"}})");
  EXPECT_EQ(constant.amount_texture->parameter, 1.4);
}

TEST(SceneForms, PaintedRegions) {
  const MaterialDescription m =
      material(R"({"type": "painted", "base": {"type": "metal"}, "paint": {"type": "lambertian"}, "mask": {"type": "region", "shapes": [
    {"sphere": [1, 2, 3], "radius": 4}, {"box": [[1, 5, 0], [0, 0, 1]]}, {"capsule": [[0, 0, 0], [0, 1, 0]], "radius": 0.5}]}})");
  EXPECT_EQ(m.kind, MaterialKind::Blend);
  EXPECT_EQ(m.a->kind, MaterialKind::Metal);
  const auto& shapes = m.amount_texture->shapes;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].radius, 4);
  EXPECT_EQ(shapes[1].kind, RegionShapeDescription::Kind::Box);
  expect_near(shapes[1].a, {0, 0, 0});
  expect_near(shapes[1].b, {1, 5, 1});
  EXPECT_EQ(shapes[2].kind, RegionShapeDescription::Kind::Capsule);
  EXPECT_EQ(
      material(
          R"({"type": "painted", "base": {"type": "metal"}, "paint": {"type": "metal"}, "mask": {"type": "mesh mask", "name": "lips"}})")
          .amount_texture->mask_name,
      "lips");
}

TEST(SceneForms, Textures) {
  const auto texture = [](const std::string& json) { return material(R"({"type": "lambertian", "albedo": )" + json + "}").albedo.texture; };
  const TexturePtr checker = texture(
      R"({"type": "checker", "even": 0.2, "odd": {"type": "marble", "base": 0.9, "veins": [0.1, 0, 0], "scale": 3}, "scale": 0.1})");
  EXPECT_EQ(checker->kind, TextureKind::Checker);
  EXPECT_EQ(checker->scale, 0.1);
  EXPECT_EQ(checker->a.spectrum->value, 0.2);
  EXPECT_EQ(checker->b.texture->kind, TextureKind::Marble);
  EXPECT_EQ(checker->b.texture->a.spectrum->value, 0.9);
  EXPECT_EQ(checker->b.texture->b.spectrum->rgb.x, 0.1);
  const TexturePtr wire = texture(R"({"type": "wireframe", "base": 0.7, "wire": 0.1, "thickness": 0.02})");
  EXPECT_EQ(wire->parameter, 0.02);
  EXPECT_EQ(wire->b.spectrum->value, 0.1);
  // Lookup transforms map world to texture space; the description keeps texture to world.
  for (const char* key :
       {R"("mapping3d": {"type": "transform", "transform": [{"scale": 2}]})", R"("mapping": {"transform": {"scale": 2}})",
        R"("mapping3d": {"type": "identity", "transform": [{"scale": 2}]})", R"("xform": {"scale": 2})", R"("transform": {"scale": 2})"})
    expect_near(texture(std::string(R"({"type": "marble", )") + key + "}")->transform.point({1, 1, 1}), {0.5, 0.5, 0.5});
}

TEST(SceneForms, Surfaces) {
  const SurfaceDescription quad =
      surface(R"({"type": "quad", "name": "q", "material": {"type": "metal"}, "size": [2, 3], "flip": true, "emit": 4})");
  EXPECT_EQ(quad.kind, SurfaceKind::Quad);
  EXPECT_EQ(quad.width, 2);
  EXPECT_EQ(quad.height, 3);
  EXPECT_TRUE(quad.flip);
  EXPECT_EQ(quad.emit->value, 4);
  EXPECT_EQ(surface(R"({"type": "quad", "material": {"type": "metal"}, "size": 5})").height, 5);
  EXPECT_EQ(surface(R"({"type": "quad", "material": {"type": "metal"}})").width, 1);
  EXPECT_EQ(surface(R"({"type": "sphere", "material": {"type": "metal"}})").radius, 1);
  const SurfaceDescription t =
      surface(R"({"type": "triangle", "material": {"type": "metal"}, "v0": [0, 0, 0], "v1": [1, 0, 0], "v2": [0, 1, 0]})");
  EXPECT_EQ(t.mesh->positions.at(1).x, 1);
  const SurfaceDescription d = surface(
      R"({"type": "triangle", "material": {"type": "metal"}, "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "normals": [[0, 0, 2], [0, 0, 1], [0, 1, 1]], "uvs": [[0, 0], [1, 0], [0, 1]]})");
  EXPECT_EQ(d.mesh->normals.at(0).z, 1);
  EXPECT_EQ(d.mesh->uvs.at(2)[1], 1);
}

}  // namespace
}  // namespace stokes
