// Files that a scene names: OBJ meshes, CSV spectra and matrices, images. Good ones are read, bad ones name their fault.
#include <cmath>
#include <sstream>

#include "scene/json_source.h"
#include "image/image_file.h"
#include "unit/scene_support.h"

namespace stokes {
namespace {

const std::string kMesh = R"({"camera": {}, "materials": [{"type": "metal", "name": "own"}, {"type": "lambertian", "name": "x-red"}],
  "surfaces": [{"type": "mesh", "filename": "a.obj", "material": "own")";

std::string mesh_scene(const std::string& members = "") { return kMesh + members + "}]}"; }

// The error that an OBJ file with this text gives, from the line number of the file on.
std::string obj_error(const std::string& obj) {
  const TemporaryFolder folder;
  folder.file("a.obj", obj);
  const std::string line = folder.error_of(mesh_scene());
  const auto at = line.find("a.obj");
  return at == std::string::npos ? line : line.substr(at);
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const std::string kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(SceneMesh, PolygonsBecomeFans) {
  const TemporaryFolder folder;
  folder.file("a.obj", "# comment\n" + kTriangle + "v 1 1 0\nf 1 2 4 3 # quad\nv 0 0 9 # unused\nf -5 -4 -3\n");
  const SceneDescription s = folder.read(mesh_scene());
  ASSERT_EQ(s.surfaces.size(), 1u);
  EXPECT_EQ(s.surfaces[0].mesh->triangles.size(), 3u);
  EXPECT_EQ(s.surfaces[0].mesh->positions.size(), 4u);
  EXPECT_TRUE(s.surfaces[0].mesh->normals.empty());
  EXPECT_TRUE(s.warnings.empty());
}

TEST(SceneMesh, NormalsAndUvsGetVerticesOfTheirOwn) {
  const TemporaryFolder folder;
  folder.file("a.obj", kTriangle + "v 1 1 0\nvn 0 0 2\nvt 0.25 0.5\nf 1/1/1 2/1/1 3/1/1\nf 2 4 3\n");
  const auto mesh = folder.read(mesh_scene()).surfaces.at(0).mesh;
  EXPECT_EQ(mesh->positions.size(), 6u);
  ASSERT_EQ(mesh->normals.size(), 6u);
  ASSERT_EQ(mesh->uvs.size(), 6u);
  for (const Vec3d& n : mesh->normals) EXPECT_EQ(n.z, 1);
  EXPECT_EQ(mesh->uvs[0][1], 0.5);
  EXPECT_EQ(mesh->uvs[mesh->triangles[1][1]][0], 1);  // a corner without uv gets the barycentric one
}

TEST(SceneMesh, MaterialsByUsemtl) {
  const TemporaryFolder folder;
  folder.file("a.obj", kTriangle + "f 1 2 3\nusemtl red\nf 1 3 2\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 2 3\n");
  const SceneDescription s = folder.read(mesh_scene(R"(, "material prefix": "x-", "inside": "air")"));
  ASSERT_EQ(s.surfaces.size(), 3u);
  EXPECT_EQ(s.surfaces[0].material->name, "own");
  EXPECT_EQ(s.surfaces[1].material->name, "x-red");
  EXPECT_EQ(s.surfaces[1].mesh->triangles.size(), 2u);
  EXPECT_EQ(s.surfaces[2].material->name, "own");
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_THAT(s.warnings[0], testing::HasSubstr("\"x-blue\""));
}

TEST(SceneMesh, BadFiles) {
  EXPECT_EQ(obj_error(kTriangle + "f 1 2 4\n"), "a.obj: a face refers to vertex 4 of 3");
  EXPECT_EQ(obj_error(kTriangle + "f -1 -2 -4\n"), "a.obj: a face refers to a vertex before the first");
  EXPECT_EQ(obj_error(kTriangle + "f 1//1 2//1 3//1\n"), "a.obj: a face refers to normal 1 of 0");
  EXPECT_EQ(obj_error(kTriangle + "f 1/7 2/7 3/7\n"), "a.obj: a face refers to texture coordinate 7 of 0");
  EXPECT_EQ(obj_error(kTriangle + "f 0 1 2\n"), "a.obj:4: \"0\" is no corner of a face");
  EXPECT_EQ(obj_error(kTriangle + "f 1 2 x\n"), "a.obj:4: \"x\" is no corner of a face");
  EXPECT_EQ(obj_error(kTriangle + "f 1 2 3.5\n"), "a.obj:4: \"3.5\" is no corner of a face");
  EXPECT_EQ(obj_error(kTriangle + "f 1 2\n"), "a.obj:4: a face needs at least three corners");
  EXPECT_EQ(obj_error("v 0 0 nan\n"), "a.obj:1: the coordinate nan is not finite or too large");
  EXPECT_EQ(obj_error("v 0 inf 0\n"), "a.obj:1: the coordinate inf is not finite or too large");
  EXPECT_EQ(obj_error("v 0 1e30 0\n"), "a.obj:1: the coordinate 1e30 is not finite or too large");
  EXPECT_EQ(obj_error("v 0 garbage 0\n"), "a.obj:1: \"garbage\" is not a number");
  EXPECT_EQ(obj_error("v 0 1\n"), "a.obj:1: \"v\" needs 3 numbers");
  EXPECT_EQ(obj_error(kTriangle), "a.obj holds no faces");
  EXPECT_EQ(obj_error(""), "a.obj holds no faces");
  EXPECT_THAT(obj_error("v 0 0 0\nf 1 1 1\n"), testing::EndsWith("/surfaces/0: no triangle of the mesh has an area"));
}

TEST(SceneMesh, DegenerateTrianglesAreDroppedAndCounted) {
  const TemporaryFolder folder;
  folder.file("a.obj", kTriangle + "v 0.5 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\n");
  const SceneDescription s = folder.read(mesh_scene());
  EXPECT_EQ(s.surfaces.at(0).mesh->triangles.size(), 1u);
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_THAT(s.warnings[0], testing::EndsWith("warning: /surfaces/0: 2 of 3 triangles have no area and were dropped"));
}

TEST(SceneMesh, OffsetMovesAlongNormalsInSceneUnits) {
  const TemporaryFolder folder;
  folder.file("a.obj", kCube);
  const SurfaceDescription s = folder.read(mesh_scene(R"(, "offset": -0.5, "transform": {"scale": [10, 10, -10]})")).surfaces.at(0);
  // The corner's normal is the diagonal, so each coordinate moves by 0.5 / sqrt(3) towards the middle.
  for (const Vec3d& p : s.mesh->positions) {
    const Vec3d world = s.transform.point(p);
    for (int i = 0; i < 3; i++) EXPECT_NEAR(std::abs(world[i]), 10 - 0.5 / std::sqrt(3.0), 1e-6);
  }
}

TEST(SceneMesh, OffsetCountsTurnedFaces) {
  const TemporaryFolder folder;
  folder.file("a.obj", kCube);
  // A slab shrunk by more than half its thickness: its four narrow sides turn inside out.
  const SceneDescription s = folder.read(mesh_scene(R"(, "offset": -3, "transform": {"scale": [10, 10, 1]})"));
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_THAT(s.warnings[0], testing::EndsWith("/surfaces/0/offset: the offset turned 8 of 12 triangles over"));
}

TEST(SceneMesh, OffsetByDistanceField) {
  const TemporaryFolder folder;
  folder.file("a.obj", kCube);
  const SurfaceDescription s =
      folder.read(mesh_scene(R"(, "offset": -0.5, "offset method": "distance field", "transform": {"scale": 10})")).surfaces.at(0);
  double largest = 0;
  for (const Vec3d& p : s.mesh->positions) largest = std::max(largest, s.transform.point(p).x);
  EXPECT_NEAR(largest, 9.5, 0.01);
  folder.file("a.obj", kTriangle + "f 1 2 3\n");
  EXPECT_THAT(folder.error_of(mesh_scene(R"(, "offset": -0.5, "offset_method": "distance_field")")),
              testing::HasSubstr(": /surfaces/0/offset: "));
}

TEST(SceneMesh, Generators) {
  const auto scene = [](const std::string& members) {
    return with(R"("surfaces": [{"type": "mesh", "material": {"type": "metal"}, )" + members + "}]");
  };
  const SceneDescription head = parse(scene(R"("generator": "head", "resolution": 8, "parameters": {"pitch": 5})"));
  EXPECT_GT(head.surfaces.at(0).mesh->triangles.size(), 1000u);
  EXPECT_FALSE(head.surfaces.at(0).mesh->masks.empty());
  EXPECT_GT(parse(scene(R"("generator": "hand", "resolution": 6, "pose": "cupping")")).surfaces.at(0).mesh->triangles.size(), 100u);
  EXPECT_THAT(error_of(scene(R"("generator": "head", "resolution": 8, "parameters": {"pich": 5})")),
              testing::HasSubstr(": /surfaces/0: the head has no parameter \"pich\""));
  EXPECT_THAT(error_of(scene(R"("generator": "head", "resolution": 0)")),
              testing::HasSubstr(": /surfaces/0/resolution: 0 is outside [0.3, 10]"));
}

TEST(SceneSpectrumFile, TwoColumns) {
  const TemporaryFolder folder;
  folder.file("a.csv", "# from somewhere\nnm, value\n400, 0.25 # first\n\n500,0.5\r\n");
  const auto s = folder.read(R"({"camera": {}, "background": {"type": "file", "filename": "a.csv", "scale": 2}})").background.emission;
  EXPECT_EQ(s->kind, SpectrumKind::Sampled);
  EXPECT_EQ(s->wavelengths, (std::vector<double>{400, 500}));
  EXPECT_EQ(s->values, (std::vector<double>{0.25, 0.5}));
}

TEST(SceneSpectrumFile, BadFiles) {
  const auto error = [](const std::string& csv) {
    const TemporaryFolder folder;
    folder.file("a.csv", csv);
    const std::string line = folder.error_of(R"({"camera": {}, "background": {"type": "file", "filename": "a.csv"}})");
    EXPECT_THAT(line, testing::HasSubstr(": /background/filename: "));
    return line;
  };
  EXPECT_THAT(error("400,1\n500,2,3\n"), testing::EndsWith("a.csv:2: expected two columns, nm and value, not 3"));
  EXPECT_THAT(error("400,1\n500,x\n"), testing::EndsWith("a.csv:2: \"x\" is not a number"));
  EXPECT_THAT(error("nm,v\nnm,v\n"), testing::EndsWith("a.csv:2: \"nm\" is not a number"));
  EXPECT_THAT(error("400,inf\n"), testing::EndsWith("a.csv:1: the sample is not finite"));
  EXPECT_THAT(error("500,1\n400,1\n"), testing::EndsWith("wavelengths must increase, and 400 follows 500"));
  EXPECT_THAT(error("500,1\n500,1\n"), testing::EndsWith("wavelengths must increase, and 500 follows 500"));
  EXPECT_THAT(error("# nothing\n"), testing::EndsWith("the file holds no samples"));
}

TEST(SceneReradiation, FirstRowIsIncoming) {
  const TemporaryFolder folder;
  folder.file("m.csv", "out\\in,300,310,320\n400,1,2,3\n410,4,5,-0.01\n");
  const std::string scene = R"({"camera": {}, "surfaces": [{"type": "quad", "material": {"type": "reradiation", "filename": "m.csv"}}]})";
  const auto m = folder.read(scene).surfaces.at(0).material->matrix;
  EXPECT_EQ(m->li, (std::vector<double>{300, 310, 320}));
  EXPECT_EQ(m->lo, (std::vector<double>{400, 410}));
  EXPECT_EQ(m->values, (std::vector<double>{1, 2, 3, 4, 5, -0.01}));
  folder.file("m.csv", "out\\in,300,310,330\n400,1,2,3\n410,4,5,6\n");
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("incoming bands must increase in equal steps, and 330 follows 310"));
  folder.file("m.csv", "out\\in,300,310,320\n400,1,2\n");
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("m.csv:2: 3 columns, where the first row has 4"));
  folder.file("m.csv", "out\\in,300,310\n400,1,nan\n410,1,1\n");
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("m.csv:2: \"nan\" is not a finite number"));
}

// The layout of Fichet et al. 2021: T.<in>nm is the diagonal, T.<in>nm.<out>nm the rest; several pixels count as their mean.
TEST(SceneReradiation, BispectralExr) {
  const TemporaryFolder folder;
  const auto write = [&](std::vector<Image::Channel> channels) {
    Image image;
    image.width = 2;
    image.height = 1;
    image.channels = std::move(channels);
    write_exr(folder.path() + "/m.exr", image);
  };
  const std::string scene = R"({"camera": {}, "surfaces": [{"type": "quad", "material": {"type": "reradiation", "filename": "m.exr"}}]})";
  write({{"R", {1, 1}},
         {"T.400,000000nm", {0.5f, 0.5f}},
         {"T.450,000000nm", {0.25f, 0.25f}},
         {"T.500,000000nm", {0.125f, 0.125f}},
         {"T.400,000000nm.500,000000nm", {0.25f, 0.5f}},
         {"T.450,000000nm.4,5e2nm.extra", {9, 9}},
         {"T.4,5e2nm.500,000000nm", {-0.0625f, -0.0625f}}});
  const auto m = folder.read(scene).surfaces.at(0).material->matrix;
  EXPECT_EQ(m->li, (std::vector<double>{400, 450, 500}));
  EXPECT_EQ(m->lo, (std::vector<double>{400, 450, 500}));
  EXPECT_EQ(m->values, (std::vector<double>{0.5, 0, 0, 0, 0.25, 0, 0.375, -0.0625, 0.125}));

  write({{"R", {1, 1}}, {"S0.400,000000nm", {1, 1}}});
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("m.exr: there are no channels called T.<nm>nm or T.<in>nm.<out>nm"));
  write({{"T.400,000000nm", {1, 1}}, {"T.450,000000nm", {1, 1}}, {"T.550,000000nm", {1, 1}}});
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("incoming bands must increase in equal steps, and 550 follows 450"));
  write({{"T.400,000000nm", {1, NAN}}, {"T.450,000000nm", {1, 1}}});
  EXPECT_THAT(folder.error_of(scene), testing::EndsWith("the channel T.400,000000nm is not finite"));
  folder.file("m.exr", "no image");
  EXPECT_THAT(folder.error_of(scene), testing::HasSubstr("m.exr: "));
}

TEST(SceneImage, EightBitFilesAreDecodedFromSrgb) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& members) {
    return folder
        .read(
            R"({"camera": {}, "surfaces": [{"type": "quad", "material": {"type": "lambertian", "albedo": {"type": "image", "filename": "a.ppm")" +
            members + "}}}]}")
        .surfaces.at(0)
        .material->albedo.texture;
  };
  const char bytes[] = "P6 2 1 255\n\xff\x80\x00\x00\x00\xff";
  folder.file("a.ppm", std::string(bytes, sizeof bytes - 1));
  const TexturePtr t = read("");
  ASSERT_EQ(t->image->width, 2);
  ASSERT_EQ(t->image->height, 1);
  ASSERT_EQ(t->image->rgb.size(), 6u);
  EXPECT_NEAR(t->image->rgb[0], 1, 1e-6);
  EXPECT_NEAR(t->image->rgb[1], 0.2158605, 1e-6);
  EXPECT_EQ(t->image->rgb[2], 0);
  EXPECT_FALSE(t->clamp);
  EXPECT_FALSE(t->nearest);
  const TexturePtr raw = read(R"(, "raw": true, "wrap": "clamp", "filter": "nearest")");
  EXPECT_NEAR(raw->image->rgb[1], 128.0 / 255, 1e-6);
  EXPECT_TRUE(raw->clamp);
  EXPECT_TRUE(raw->nearest);
  folder.file("a.ppm", "not an image");
  EXPECT_THROW(read(""), SceneError);
}

TEST(SceneImage, EnvironmentMap) {
  const TemporaryFolder folder;
  std::string pixels = "PF\n1 1\n-1.0\n";
  for (const float v : {2.0f, 0.5f, 0.25f}) pixels.append(reinterpret_cast<const char*>(&v), sizeof v);
  folder.file("sky.pfm", pixels);
  const auto b =
      folder.read(R"({"camera": {}, "background": {"type": "environment", "filename": "sky.pfm", "rotate": 90, "scale": 2}})").background;
  ASSERT_NE(b.environment, nullptr);
  EXPECT_EQ(b.emission, nullptr);
  EXPECT_EQ(b.environment->rgb, (std::vector<float>{2.0f, 0.5f, 0.25f}));
  EXPECT_EQ(b.rotate, 90);
  EXPECT_EQ(b.scale, 2);
}

// Generated meshes as coarse as a test needs.
void coarse_meshes(const Json& surfaces, const std::string& pointer, SceneOverrides& overrides) {
  for (std::size_t i = 0; i < surfaces.size(); i++) {
    const std::string at = pointer + "/" + std::to_string(i);
    if (surfaces[i].contains("generator")) overrides.emplace_back(at + "/resolution", "8");
    if (surfaces[i].contains("children")) coarse_meshes(surfaces[i]["children"], at + "/children", overrides);
  }
}

// Every scene of the project is valid, says nothing that needs a warning, and stands in the manual.
TEST(SceneFolder, EverySceneIsReadAndDescribed) {
  const std::filesystem::path folder = std::filesystem::path(STOKES_SOURCE_DIR) / "scenes";
  std::stringstream manual;
  manual << std::ifstream(folder / "README.md").rdbuf();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem().string();
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    SceneOverrides coarse;
    coarse_meshes(parse_json(text.str(), name).root.value("surfaces", Json::array()), "/surfaces", coarse);
    SceneDescription scene;
    EXPECT_NO_THROW(scene = read_scene(entry.path().string(), coarse)) << name;
    EXPECT_THAT(scene.warnings, testing::IsEmpty()) << name;
    EXPECT_THAT(manual.str(), testing::HasSubstr("`" + name + "`"));
    count++;
  }
  EXPECT_GE(count, 40);
}

}  // namespace
}  // namespace stokes
