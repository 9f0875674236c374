// pbrt's conventions, directive by directive, as pbrt-v4's own reader (scene, parser, lights, parameters) has them.
#include <numbers>

#include "import_support.h"
#include "spectral/tabulate.h"

namespace stokes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using ImportPbrt = ImportTest;

double degrees(double tangent) { return 2 * std::atan(tangent) * 180 / std::numbers::pi; }

// Of the scene's only surface.
ImportJson surface_of(const ImportedScene& scene) {
  EXPECT_EQ(scene.json["surfaces"].size(), 1u);
  return scene.json["surfaces"].at(0);
}

TEST_F(ImportPbrt, WhatIsNotSaidHasPbrtsDefaults) {
  const ImportedScene scene = pbrt("Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\n");
  EXPECT_EQ(scene.json["camera"]["resolution"], ImportJson({1280, 720}));
  EXPECT_NEAR(scene.json["camera"]["vfov"].get<double>(), 90, 1e-9);
  EXPECT_EQ(scene.json["sampler"]["samples"], 16);
  EXPECT_EQ(scene.json["integrator"]["type"], "path tracer volumetric mis");
  EXPECT_EQ(scene.json["integrator"]["max bounces"], 5);
  EXPECT_EQ(surface_of(scene)["radius"], 1);
  EXPECT_EQ(surface_of(scene)["material"], (ImportJson{{"type", "lambertian"}, {"albedo", 0.5}}));
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST_F(ImportPbrt, TheAngleIsOfTheShorterSide) {
  const auto vfov = [&](const std::string& film, const std::string& camera) {
    const ImportedScene scene = pbrt("Film \"rgb\" " + film + " Camera \"perspective\" " + camera + " WorldBegin");
    EXPECT_THAT(scene.notes, IsEmpty());
    return scene.json["camera"]["vfov"].get<double>();
  };
  const double tangent = std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(vfov("\"integer xresolution\" 200 \"integer yresolution\" 100", "\"float fov\" 60"), 60, 1e-9);
  EXPECT_NEAR(vfov("\"integer xresolution\" 100 \"integer yresolution\" 200", "\"float fov\" 60"), degrees(2 * tangent), 1e-9);
  EXPECT_NEAR(vfov("\"integer xresolution\" 200 \"integer yresolution\" 100", "\"float fov\" 60 \"float screenwindow\" [ -1 1 -0.5 0.5 ]"), degrees(tangent / 2), 1e-9);
}

TEST_F(ImportPbrt, AWindowThatIsOffTheMiddleIsSaid) {
  const ImportedScene scene = pbrt("Camera \"perspective\"\n\"float screenwindow\" [ -1 2 -1 1 ]\nWorldBegin");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0].line, 2);
}

TEST_F(ImportPbrt, TheCameraLooksAlongZInALeftHandedFrame) {
  // From behind, +x is to the right; ours has it on the right of its own frame, which looks along -z.
  const Affine a = map_of(pbrt("LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin").json["camera"]);
  expect_vector(a.point({0, 0, 0}), {0, 0, -5});
  expect_vector(a.vector({0, 0, -1}), {0, 0, 1});
  expect_vector(a.vector({1, 0, 0}), {1, 0, 0});
  expect_vector(a.vector({0, 1, 0}), {0, 1, 0});
  const Affine mirrored = map_of(pbrt("Scale -1 1 1 LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin").json["camera"]);
  expect_vector(mirrored.vector({1, 0, 0}), {-1, 0, 0});
  expect_vector(mirrored.vector({0, 0, -1}), {0, 0, 1});
}

TEST_F(ImportPbrt, TheLensIsGivenByItsRadiusAndDistance) {
  const ImportJson camera = pbrt("Camera \"perspective\" \"float lensradius\" 0.2 \"float focaldistance\" 3 WorldBegin").json["camera"];
  EXPECT_EQ(camera["aperture"], 0.2);
  EXPECT_EQ(camera["fdist"], 3.0);
  EXPECT_EQ(pbrt("Camera \"perspective\" \"float lensradius\" 0.2 WorldBegin").json["camera"]["fdist"], 1e6);
  EXPECT_FALSE(pbrt("Camera \"perspective\" \"float focaldistance\" 3 WorldBegin").json["camera"].contains("fdist"));
}

TEST_F(ImportPbrt, TransformsComposeFromTheRightAndMatricesStandByColumns) {
  const auto place = [&](const std::string& transforms) { return map_of(surface_of(pbrt("WorldBegin " + transforms + " Shape \"sphere\""))); };
  expect_vector(place("Translate 1 2 3 Scale 2 2 2").point({1, 0, 0}), {3, 2, 3});
  expect_vector(place("Rotate 90 0 0 5").point({1, 0, 0}), {0, 1, 0});
  expect_vector(place("Translate 9 9 9 Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  4 5 6 1 ]").point({0, 0, 0}), {4, 5, 6});
  expect_vector(place("Scale 2 2 2 ConcatTransform [ 0 1 0 0  -1 0 0 0  0 0 1 0  4 5 6 1 ]").point({1, 0, 0}), {8, 12, 12});
  expect_vector(place("Translate 1 0 0 Identity").point({0, 0, 0}), {0, 0, 0});
  expect_vector(place("Translate 1 0 0 CoordinateSystem \"a\" Translate 5 0 0 CoordSysTransform \"a\"").point({0, 0, 0}), {1, 0, 0});
  // The camera's frame is known by name, the options' transform ends with WorldBegin.
  expect_vector(map_of(surface_of(pbrt("Translate 0 0 7 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"sphere\""))).point({0, 0, 0}), {0, 0, -7});
  expect_vector(map_of(surface_of(pbrt("Translate 0 0 7 WorldBegin Shape \"sphere\""))).point({0, 0, 0}), {0, 0, 0});
}

TEST_F(ImportPbrt, NothingMoves) {
  const ImportedScene scene = pbrt("Camera \"perspective\" WorldBegin\nActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\nShape \"sphere\"");
  expect_vector(map_of(surface_of(scene)).point({0, 0, 0}), {0, 0, 0});
  ASSERT_EQ(scene.notes.size(), 2u);
  EXPECT_EQ(scene.notes[0].line, 2);
  EXPECT_EQ(scene.notes[1].line, 3);
}

TEST_F(ImportPbrt, AttributesEndWithTheirBlock) {
  const ImportedScene scene = pbrt(R"(WorldBegin
AttributeBegin
  Material "diffuse" "rgb reflectance" [ 1 0 0 ]
  AreaLightSource "diffuse"
  ReverseOrientation
  Translate 1 0 0
  TransformBegin
    Translate 1 0 0
    ReverseOrientation
    Shape "sphere"
  TransformEnd
  Shape "sphere"
AttributeEnd
Shape "sphere")");
  const ImportJson& s = scene.json["surfaces"];
  ASSERT_EQ(s.size(), 3u);
  // TransformEnd brings back the transform alone.
  expect_vector(map_of(s[0]).point({0, 0, 0}), {2, 0, 0});
  EXPECT_FALSE(s[0].contains("flip"));
  expect_vector(map_of(s[1]).point({0, 0, 0}), {1, 0, 0});
  EXPECT_FALSE(s[1].contains("flip"));
  EXPECT_TRUE(s[1].contains("emit"));
  EXPECT_FALSE(s[2].contains("transform") || s[2].contains("emit") || s[2].contains("flip"));
  EXPECT_EQ(s[2]["material"]["albedo"], 0.5);
}

TEST_F(ImportPbrt, ReversedShapesAreFlipped) { EXPECT_EQ(surface_of(pbrt("WorldBegin ReverseOrientation Shape \"sphere\""))["flip"], true); }

TEST_F(ImportPbrt, LampsShineWithALuminanceOfTheirScale) {
  const auto emit = [&](const std::string& parameters) { return surface_of(pbrt("WorldBegin AreaLightSource \"diffuse\" " + parameters + " Shape \"sphere\""))["emit"]; };
  EXPECT_EQ(emit(""), 1.0);
  EXPECT_EQ(emit("\"float scale\" 3"), 3.0);
  EXPECT_EQ(emit("\"rgb L\" [ 1 2 4 ] \"float scale\" 2"), ImportJson({2.0, 4.0, 8.0}));
  EXPECT_EQ(emit("\"blackbody L\" 3000 \"float scale\" 2"), (ImportJson{{"type", "blackbody"}, {"temperature", 3000.0}, {"scale", 2.0}}));
  EXPECT_EQ(emit("\"spectrum L\" \"stdillum-A\""), (ImportJson{{"type", "illuminant"}, {"name", "A"}}));
  // Any other curve is brought to a luminance of 1 first: 0.01 at every visible wavelength becomes 1.
  const ImportJson flat = emit("\"spectrum L\" [ 300 0.01 830 0.01 ] \"float scale\" 5");
  EXPECT_NEAR(flat["scale"].get<double>() * 0.01, 5, 1e-3);
  EXPECT_EQ(flat["extrapolate"], "zero");
  write("lamp.spd", "# a lamp\n300 4\n830 4\n");
  EXPECT_NEAR(emit("\"spectrum L\" \"lamp.spd\"")["scale"].get<double>() * 4, 1, 1e-3);
}

TEST_F(ImportPbrt, ALampThatCannotBeSeenIsSaid) {
  const ImportedScene scene = pbrt("Camera \"perspective\" WorldBegin AreaLightSource \"diffuse\" \"spectrum L\" [ 300 1 350 1 ] Shape \"sphere\"");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(scene.notes[0].message, HasSubstr("cannot be seen"));
}

TEST_F(ImportPbrt, SkiesAreOfTheirScaleOrIlluminance) {
  const auto sky = [&](const std::string& parameters) { return pbrt("WorldBegin LightSource \"infinite\" " + parameters).json["background"]; };
  EXPECT_EQ(sky(""), 1.0);
  EXPECT_EQ(sky("\"rgb L\" [ 1 0 0 ] \"float scale\" 2"), ImportJson({2.0, 0.0, 0.0}));
  EXPECT_NEAR(sky("\"float illuminance\" 10").get<double>(), 10 / std::numbers::pi, 1e-9);
  const ImportedScene map = pbrt("Camera \"perspective\" WorldBegin Rotate 30 0 1 0 LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 2");
  EXPECT_EQ(map.json["background"], (ImportJson{{"type", "environment"}, {"filename", "sky.exr"}, {"scale", 2.0}}));
  EXPECT_EQ(map.notes.size(), 2u);  // its parameterisation and its transform
}

TEST_F(ImportPbrt, MaterialsHaveTheirDefaults) {
  const auto material = [&](const std::string& text) { return surface_of(pbrt("WorldBegin Material " + text + " Shape \"sphere\""))["material"]; };
  EXPECT_EQ(material("\"diffuse\""), (ImportJson{{"type", "lambertian"}, {"albedo", 0.5}}));
  EXPECT_EQ(material("\"dielectric\""), (ImportJson{{"type", "dielectric"}, {"ior", 1.5}}));
  EXPECT_EQ(material("\"interface\""), (ImportJson{{"type", "interface"}}));
  EXPECT_EQ(material("\"dielectric\" \"float roughness\" 0.09 \"float eta\" 1.3"), (ImportJson{{"type", "dielectric"}, {"ior", 1.3}, {"alpha", 0.3}}));
  EXPECT_EQ(material("\"dielectric\" \"float uroughness\" 0.2 \"float vroughness\" 0.2 \"bool remaproughness\" false")["alpha"], 0.2);
  // Copper, smooth.
  const ImportJson copper = material("\"conductor\"");
  EXPECT_EQ(copper["eta"]["values"][0], 1.31);
  EXPECT_EQ(copper["k"]["values"][6], 4.16);
  EXPECT_FALSE(copper.contains("alpha"));
  EXPECT_EQ(material("\"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" 0.25")["alpha"], 0.5);
  EXPECT_EQ(material("\"conductor\" \"spectrum eta\" \"metal-Al-eta\" \"spectrum k\" [ 400 4 700 8 ]")["k"]["values"], ImportJson({4.0, 8.0}));
}

TEST_F(ImportPbrt, AConductorsReflectanceIsItsKAtAnIndexOfOne) {
  const ImportJson metal = surface_of(pbrt("WorldBegin Material \"conductor\" \"spectrum reflectance\" [ 280 0.8 780 0.8 ] Shape \"sphere\""))["material"];
  EXPECT_EQ(metal["eta"], 1.0);
  const double k = metal["k"]["values"][40].get<double>();
  EXPECT_NEAR(k * k / (4 + k * k), 0.8, 1e-4);
}

TEST_F(ImportPbrt, NamedMaterialsMayComeLater) {
  const ImportedScene scene = pbrt(R"(Camera "perspective" WorldBegin
NamedMaterial "a" Shape "sphere"
MakeNamedMaterial "a" "string type" "diffuse" "spectrum reflectance" [ 400 0.1 700 0.9 ]
MakeNamedMaterial "b" "string type" "interface"
MakeNamedMaterial "c" "string type" "mix" "string materials" [ "a" "b" ] "float amount" 0.3)");
  EXPECT_EQ(surface_of(scene)["material"], "a");
  EXPECT_EQ(scene.json["materials"][0]["albedo"]["extrapolate"], "zero");
  EXPECT_EQ(scene.json["materials"][2], (ImportJson{{"type", "blend"}, {"a", "a"}, {"b", "b"}, {"amount", 0.3}, {"name", "c"}}));
  EXPECT_THAT(scene.notes, IsEmpty());
  EXPECT_EQ(pbrt_error("WorldBegin\nNamedMaterial \"a\""), "2: error: no material is called \"a\"");
}

TEST_F(ImportPbrt, MediaArePerSceneUnitAndScaled) {
  const ImportJson media = pbrt(R"(MakeNamedMedium "milk" "string type" "homogeneous"
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ 1 2 3 ] "spectrum sigma_s" [ 400 1 700 2 ] "float scale" 10 "float g" -0.4
WorldBegin)").json["media"];
  EXPECT_EQ(media[0], (ImportJson{{"type", "homogeneous"}, {"name", "milk"}, {"sigma_a", {0.0011, 0.0024, 0.014}}, {"sigma_s", {2.55, 3.21, 3.77}}}));
  EXPECT_EQ(media[1]["sigma_a"], ImportJson({10.0, 20.0, 30.0}));
  EXPECT_EQ(media[1]["sigma_s"]["scale"], 10.0);
  EXPECT_EQ(media[1]["g"], -0.4);
}

TEST_F(ImportPbrt, AnInterfaceNamesInsideThenOutside) {
  const std::string media = "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" MakeNamedMedium \"b\" \"string type\" \"homogeneous\" ";
  const auto sides = [&](const std::string& text) {
    const ImportJson s = surface_of(pbrt(media + text + " Shape \"sphere\""));
    return s.value("inside", std::string()) + "|" + s.value("outside", std::string());
  };
  EXPECT_EQ(sides("WorldBegin MediumInterface \"a\" \"b\""), "a|b");
  EXPECT_EQ(sides("WorldBegin MediumInterface \"a\" \"\""), "a|");
  // One name is both sides, which is no transition: rays keep their medium.
  EXPECT_EQ(sides("WorldBegin MediumInterface \"a\""), "|");
  EXPECT_EQ(sides("MediumInterface \"\" \"b\" Camera \"perspective\" WorldBegin MediumInterface \"a\""), "b|b");
  EXPECT_EQ(sides("WorldBegin"), "|");
  // What stands at the camera is the camera's; a shape without an interface stands in it.
  EXPECT_EQ(pbrt(media + "MediumInterface \"\" \"b\" Camera \"perspective\" WorldBegin").json["camera"]["medium"], "b");
  EXPECT_FALSE(pbrt(media + "Camera \"perspective\" MediumInterface \"\" \"b\" WorldBegin").json["camera"].contains("medium"));
  EXPECT_EQ(sides("MediumInterface \"\" \"b\" Camera \"perspective\" WorldBegin MediumInterface \"\" \"\""), "b|b");
  EXPECT_EQ(pbrt_error("WorldBegin\n\nMediumInterface \"a\" \"\""), "3: error: no medium is called \"a\"");
}

TEST_F(ImportPbrt, AMediumMayBeMadeAfterItsUse) {
  EXPECT_EQ(surface_of(pbrt("WorldBegin MediumInterface \"a\" \"\" Shape \"sphere\" MakeNamedMedium \"a\" \"string type\" \"homogeneous\""))["inside"], "a");
}

TEST_F(ImportPbrt, FacesLookWhereTheirNormalsPoint) {
  const auto triangle = [&](const std::string& normal) {
    return pbrt("WorldBegin Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] \"normal N\" [ " + normal + normal + normal + "]").meshes.at(0).second.triangles.at(0);
  };
  EXPECT_THAT(triangle("0 0 1 "), ElementsAre(0, 1, 2));
  EXPECT_THAT(triangle("0 0 -1 "), ElementsAre(0, 2, 1));
}

TEST_F(ImportPbrt, TexturedTrianglesWithoutCoordinatesHaveThoseOfPbrt) {
  const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] \"integer indices\" [ 0 1 2 0 2 3 ]";
  const std::string texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" Material \"diffuse\" \"texture reflectance\" \"t\" ";
  EXPECT_THAT(pbrt("WorldBegin " + mesh).meshes.at(0).second.uvs, IsEmpty());
  const ImportedMesh textured = pbrt("WorldBegin " + texture + mesh).meshes.at(0).second;
  ASSERT_EQ(textured.uvs.size(), 6u);
  EXPECT_THAT(textured.uvs[1], ElementsAre(1, 0));
  EXPECT_THAT(textured.uvs[5], ElementsAre(1, 1));
}

TEST_F(ImportPbrt, TexturesOfFloatsAndOfSpectraHaveNamesOfTheirOwn) {
  const ImportJson material = surface_of(pbrt(R"(WorldBegin
Texture "t" "float" "constant" "float value" 0.25
Texture "t" "spectrum" "imagemap" "string filename" "a.png" "string wrap" "clamp" "float scale" 0.5
Texture "u" "spectrum" "scale" "texture tex" "t" "texture scale" "t"
Material "dielectric" "texture roughness" "t"
Material "diffuse" "texture reflectance" "u"
Shape "sphere")"))["material"];
  EXPECT_EQ(material["albedo"], (ImportJson{{"type", "image"}, {"filename", "a.png"}, {"wrap", "clamp"}, {"scale", 0.125}}));
}

TEST_F(ImportPbrt, ObjectsAreSeenWhereTheyAreInstanced) {
  const ImportedScene scene = pbrt(R"(WorldBegin
Translate 0 1 0
ObjectBegin "ball"
  Translate 1 0 0
  Shape "sphere"
ObjectEnd
Identity
Translate 0 0 5
ObjectInstance "ball"
Shape "sphere")");
  const ImportJson& s = scene.json["surfaces"];
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0]["type"], "group");
  expect_vector(map_of(s[0]).point(map_of(s[0]["children"][0]).point({0, 0, 0})), {1, 1, 5});
  expect_vector(map_of(s[1]).point({0, 0, 0}), {0, 0, 5});
  EXPECT_EQ(pbrt_error("WorldBegin\nObjectInstance \"ball\""), "2: error: no object is called \"ball\"");
}

TEST_F(ImportPbrt, FilesAreNamedFromTheScenesFolder) {
  write("parts/inner.pbrt", "Include \"parts/deeper.pbrt\"\n");
  write("parts/deeper.pbrt", "Translate 1 0 0\nShape \"sphere\"\n");
  EXPECT_EQ(pbrt("WorldBegin Include \"parts/inner.pbrt\" Shape \"sphere\"").json["surfaces"].size(), 2u);
  // What an imported file sets ends with it; an included one goes on.
  expect_vector(map_of(pbrt("WorldBegin Include \"parts/inner.pbrt\" Shape \"sphere\"").json["surfaces"][1]).point({0, 0, 0}), {1, 0, 0});
  expect_vector(map_of(pbrt("WorldBegin Import \"parts/inner.pbrt\" Shape \"sphere\"").json["surfaces"][1]).point({0, 0, 0}), {0, 0, 0});
}

TEST_F(ImportPbrt, WhatCannotBeMeantIsRefusedAtItsLine) {
  EXPECT_EQ(pbrt_error("Camera \"perspective\"\n"), "1: error: this is no pbrt scene: it has no WorldBegin");
  EXPECT_EQ(pbrt_error("WorldBegin\nTranslate 1 2"), "2: error: Translate needs 3 numbers");
  EXPECT_EQ(pbrt_error("WorldBegin\nAttributeEnd"), "2: error: AttributeEnd without its beginning");
  EXPECT_EQ(pbrt_error("WorldBegin\nAttributeBegin"), "1: error: an AttributeBegin, TransformBegin or ObjectBegin has no end");
  EXPECT_EQ(pbrt_error("WorldBegin\nMaterial \"diffuse\"\n\"spectrum reflectance\" [ 500 1 400 1 ]"), "3: error: the wavelengths of \"reflectance\" do not increase");
  EXPECT_EQ(pbrt_error("WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n\"integer indices\" [ 0 1 ]"), "3: error: the number of indices is no multiple of 3");
}

TEST_F(ImportPbrt, StringsHaveEscapesAndFilesMayBePacked) {
  write("a \"b.exr", "");
  const ImportedScene scene = pbrt("Camera \"perspective\" WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a \\\"b.exr\" Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"");
  EXPECT_EQ(surface_of(scene)["material"]["albedo"]["filename"], "a \"b.exr");
  EXPECT_EQ(pbrt_error("WorldBegin\nShape \"sp\\x\""), "2: error: a string has no end, or an unknown escape");
  EXPECT_EQ(pbrt_error("WorldBegin\nInclude \"gone.pbrt\""), "2: error: the file \"gone.pbrt\" cannot be read: there is no such file");
  EXPECT_THAT(pbrt_error("WorldBegin\nInclude \"scene.pbrt\""), testing::StartsWith("2: error: files include each other"));
}

TEST_F(ImportPbrt, AttributesStandWhereADirectiveHasNone) {
  const ImportedScene scene = pbrt(R"(Camera "perspective" WorldBegin
AttributeBegin Attribute "shape" "float radius" 3 Attribute "material" "rgb reflectance" [ 0.1 0.2 0.3 ] Attribute "light" "float scale" 2
Material "diffuse" AreaLightSource "diffuse" "rgb L" [ 1 2 3 ] Shape "sphere" Shape "sphere" "float radius" 1
AttributeEnd Shape "sphere" Material "diffuse" Shape "sphere")");
  EXPECT_THAT(scene.notes, IsEmpty());
  const ImportJson& surfaces = scene.json["surfaces"];
  EXPECT_EQ(surfaces[0]["radius"], 3);
  EXPECT_EQ(surfaces[0]["material"]["albedo"], ImportJson({0.1, 0.2, 0.3}));
  EXPECT_EQ(surfaces[0]["emit"], ImportJson({2.0, 4.0, 6.0}));
  EXPECT_EQ(surfaces[1]["radius"], 1);
  EXPECT_EQ(surfaces[2]["radius"], 1);
  EXPECT_EQ(surfaces[3]["material"]["albedo"], 0.5);
  // One that no directive understands is noted, once.
  const ImportedScene strange = pbrt("Camera \"perspective\" WorldBegin\nAttribute \"shape\" \"float alpha\" 0.5\nShape \"sphere\" AttributeBegin Shape \"sphere\" AttributeEnd");
  ASSERT_THAT(strange.notes, testing::SizeIs(1));
  EXPECT_EQ(strange.notes[0].line, 2);
  EXPECT_THAT(pbrt_error("WorldBegin\nAttribute \"shapes\" \"float radius\" 3"), testing::StartsWith("2: error: "));
}

TEST_F(ImportPbrt, WhatPbrtRefusesIsRefusedAtItsLine) {
  for (const char* text : {"Rotate 30 0 0 0", "Scale 0 1 1", "LookAt 0 0 0 0 1 0 0 1 0", "AttributeBegin TransformEnd", "TransformBegin AttributeEnd", "Shape \"sphere\" \"flaot radius\" 3",
                           "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"a\" \"string type\" \"diffuse\"", "Shape \"plymesh\""})
    EXPECT_THAT(pbrt_error("WorldBegin\n" + std::string(text)), testing::StartsWith("2: error: ")) << text;
}

TEST_F(ImportPbrt, AnOrthographicCameraSeesTwoUnitsAlongTheShorterSide) {
  const auto height = [&](const std::string& film) { return pbrt("Film \"rgb\" " + film + " Camera \"orthographic\" WorldBegin").json["camera"]["height"].get<double>(); };
  EXPECT_DOUBLE_EQ(height("\"integer xresolution\" 400 \"integer yresolution\" 200"), 2);
  EXPECT_DOUBLE_EQ(height("\"integer xresolution\" 200 \"integer yresolution\" 400"), 4);
}

TEST_F(ImportPbrt, AShapeWithoutAnInterfaceStandsInTheMediumAroundIt) {
  const ImportedScene scene = pbrt(R"(Camera "perspective" WorldBegin MakeNamedMedium "fog" "string type" "homogeneous"
AttributeBegin MediumInterface "fog" "" Material "interface" Shape "sphere" "float radius" 5 AttributeEnd
Shape "sphere"
Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ]
Translate 20 0 0 Shape "sphere")");
  EXPECT_THAT(scene.notes, IsEmpty());
  for (const std::size_t i : {1u, 2u}) EXPECT_EQ(scene.json["surfaces"][i]["outside"], "fog");
  EXPECT_FALSE(scene.json["surfaces"][3].contains("outside"));
}

}  // namespace
}  // namespace stokes
