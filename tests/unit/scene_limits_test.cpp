// Limits on scenes and their files: each is a named error, and each can be raised. What lies outside the folders that are allowed is not read.
#include <sys/stat.h>

#include "scene/memory_error.h"
#include "unit/scene_support.h"

namespace stokes {
namespace {

// The error of a scene in `folder` with one limit set as the command line would.
std::string limited(const TemporaryFolder& folder, const std::string& text, const std::string& limit) {
  ReadOptions options;
  if (!limit.empty()) set_limit(options.limits, limit);
  try {
    read_scene_text(text, "scene.json", folder.path(), {}, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

struct Limited {
  const char* name;
  std::string scene;
  std::string limit;
  std::string message;
};

std::string quads(int count) {
  std::string list;
  for (int i = 0; i < count; i++) list += std::string(i ? "," : "") + R"({"type": "quad", "material": {"type": "metal"}})";
  return with("\"surfaces\": [" + list + "]");
}

const Limited kLimited[] = {
    {"depth", R"({"camera": {"transform": [[[]]]}})", "depth=4", "/camera/transform/0/0: nested deeper than 4 levels (--limit depth)"},
    {"values", with(R"("background": [0, 0, 0])"), "values=4", "/background/1: more than 4 values (--limit values)"},
    {"keys", R"({"camera": {"vfov": 1, "fdist": 1, "aperture": 0}})", "keys=2", "/camera/aperture: more than 2 keys in one object (--limit keys)"},
    {"surfaces", quads(3), "surfaces=2", "/surfaces: surfaces: 3 is more than the limit 2 (--limit surfaces)"},
    {"surfaces_of_groups", with(R"("surfaces": [{"type": "group", "children": [{"type": "quad", "material": {"type": "metal"}}, {"type": "quad", "material": {"type": "metal"}}]}])"),
     "surfaces=1", "/surfaces/0/children: surfaces: 2 is more than the limit 1 (--limit surfaces)"},
    {"materials", with(R"("materials": [{"type": "metal", "name": "a"}, {"type": "metal", "name": "b"}])"), "materials=1",
     "/materials: named materials: 2 is more than the limit 1 (--limit materials)"},
    {"media", with(R"("media": [{"type": "vacuum", "name": "a"}, {"type": "vacuum", "name": "b"}])"), "media=1", "/media: named media: 2 is more than the limit 1 (--limit media)"},
    {"spectra", with(R"("spectra": [{"type": "constant", "value": 1, "name": "a"}, {"type": "constant", "value": 1, "name": "b"}])"), "spectra=1",
     "/spectra: named spectra, and terms of one sum or product: 2 is more than the limit 1 (--limit spectra)"},
    {"terms", with(R"("background": {"type": "sum", "of": [1, 2, 3]})"), "spectra=3",
     "/background/of/2: named spectra, and terms of one sum or product: 4 is more than the limit 3 (--limit spectra)"},
    {"curve_samples", with(R"("background": {"type": "sampled", "wavelengths": [400, 500, 600], "values": [1, 1, 1]})"), "curve-samples=2",
     "/background/wavelengths: samples of one spectrum: 3 is more than the limit 2 (--limit curve-samples)"},
    {"side", R"({"camera": {"resolution": [64, 128]}})", "side=100", "/camera/resolution/1: 128 is outside [1, 100]"},
    {"pixels", R"({"camera": {"resolution": [64, 128]}})", "pixels=8191", "/camera/resolution: pixels of the film: 8192 is more than the limit 8191 (--limit pixels)"},
    {"samples", with(R"("sampler": {"samples": 17})"), "samples=16", "/sampler/samples: samples per pixel: 17 is more than the limit 16 (--limit samples)"},
    {"memory_of_json", with(R"("background": [0, 0, 0])"), "memory=1K", "out of memory: the scene's JSON needs 0.00 GiB, 0.00 GiB are allowed (--limit memory)"},
    {"memory_of_generator", with(R"("surfaces": [{"type": "mesh", "generator": "head", "resolution": 0.3, "material": {"type": "metal"}}])"), "memory=1G",
     "are allowed (--limit memory)"},
    {"mesh_bytes", with(R"("surfaces": [{"type": "mesh", "filename": "a.obj", "material": {"type": "metal"}}])"), "mesh-bytes=10",
     "/surfaces/0/filename: size of an OBJ file: 40 is more than the limit 10 (--limit mesh-bytes)"},
    {"vertices", with(R"("surfaces": [{"type": "mesh", "filename": "a.obj", "material": {"type": "metal"}}])"), "vertices=2",
     "/surfaces/0/filename: vertices of one mesh: 3 is more than the limit 2 (--limit vertices)"},
    {"faces", with(R"("surfaces": [{"type": "mesh", "filename": "a.obj", "material": {"type": "metal"}}])"), "faces=1",
     "/surfaces/0/filename: triangles of one mesh: 2 is more than the limit 1 (--limit faces)"},
    {"table_bytes", with(R"("background": {"type": "file", "filename": "a.csv"})"), "table-bytes=3",
     "/background/filename: size of a file of spectra or a matrix: 12 is more than the limit 3 (--limit table-bytes)"},
    {"table_samples", with(R"("background": {"type": "file", "filename": "a.csv"})"), "curve-samples=1", "a.csv:2: more than 1 samples (--limit curve-samples)"},
    {"image_bytes", with(R"("background": {"type": "environment", "filename": "a.ppm"})"), "image-bytes=3",
     "/background/filename: size of an image file: 17 is more than the limit 3 (--limit image-bytes)"},
    {"image_side", with(R"("background": {"type": "environment", "filename": "a.ppm"})"), "image-side=1",
     "a.ppm cannot be read as an image: it has 2x1 pixels, and the limit of a side is 1 (--limit image-side)"},
    {"image_pixels", with(R"("background": {"type": "environment", "filename": "a.ppm"})"), "image-pixels=1",
     "a.ppm cannot be read as an image: it has 2x1 pixels, and the limit is 1 (--limit image-pixels)"},
};

class SceneLimit : public testing::TestWithParam<Limited> {};

TEST_P(SceneLimit, IsToldByNameAndCanBeRaised) {
  const TemporaryFolder folder;
  folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  folder.file("a.csv", "400,1\n500,1\n");
  folder.file("a.ppm", std::string("P6 2 1 255\n\x01\x02\x03\x04\x05\x06", 17));
  EXPECT_THAT(limited(folder, GetParam().scene, GetParam().limit), testing::EndsWith(GetParam().message));
  const std::string name = GetParam().name;
  // Deep nonsense stays nonsense, and a fine head takes its time.
  if (name != "depth" && name != "memory_of_generator") {
    EXPECT_EQ(limited(folder, GetParam().scene, ""), "");
  }
}

INSTANTIATE_TEST_SUITE_P(All, SceneLimit, testing::ValuesIn(kLimited), [](const auto& info) { return std::string(info.param.name); });

TEST(SceneLimits, MemoryIsAnErrorOfItsOwn) {
  ReadOptions options;
  set_limit(options.limits, "memory=1K");
  EXPECT_THROW(read_scene_text(with("\"background\": [0, 0, 0]"), "scene.json", "/nonexistent", {}, options), SceneMemoryError);
}

TEST(SceneLimits, Text) {
  InputLimits limits;
  set_limit(limits, "faces=3M");
  EXPECT_EQ(limits.faces, 3u << 20);
  for (const char* text : {"faces", "faces=", "faces=-1", "faces=1.5", "faces=1T", "faces=99999999999999999999", "faces=18446744073709551615G", "facs=1", "=1"})
    EXPECT_THROW(set_limit(limits, text), std::invalid_argument) << text;
}

// Names used twice and twice again unfold to 2^40 terms; a chain is as deep as it is long.
TEST(SceneLimits, NamesDoNotUnfoldForever) {
  std::string spectra = R"({"name": "s0", "type": "constant", "value": 0.5})", materials = R"({"name": "m0", "type": "metal"})", chain = spectra;
  for (int i = 1; i <= 40; i++) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    spectra += ", {\"name\": \"s" + n + "\", \"type\": \"product\", \"of\": [\"s" + before + "\", \"s" + before + "\"]}";
    materials += ", {\"name\": \"m" + n + "\", \"type\": \"blend\", \"a\": \"m" + before + "\", \"b\": \"m" + before + "\"}";
  }
  for (int i = 1; i <= 5000; i++) chain += ", {\"name\": \"s" + std::to_string(i) + "\", \"type\": \"sum\", \"of\": [\"s" + std::to_string(i - 1) + "\"]}";
  EXPECT_THAT(error_of(with("\"spectra\": [" + spectra + "]")), testing::HasSubstr("/of/1: named spectra, and terms of one sum or product: "));
  EXPECT_THAT(error_of(with("\"materials\": [" + materials + "]")), testing::HasSubstr("/b: named materials: "));
  EXPECT_THAT(error_of(with("\"spectra\": [" + chain + "]")), testing::HasSubstr("/spectra/100/of/0: nesting of the JSON, and of spectra and materials that refer to others: 101"));
}

// The scene's folder, its parent and the working folder are allowed, whatever way leads there; all else needs the option.
TEST(SceneFiles, OutsideTheFoldersAreRefused) {
  namespace fs = std::filesystem;
  const TemporaryFolder outside, folder;
  outside.file("a.csv", "400,1\n500,1\n");
  const std::string project = folder.path() + "/project", scenes = project + "/scenes";
  for (const std::string& part : {project + "/spectra", scenes + "/sub", project + "2"}) fs::create_directories(part);
  folder.file("project/scenes/inside.csv", "400,1\n500,1\n");
  folder.file("project/spectra/beside.csv", "400,1\n500,1\n");
  folder.file("project2/a.csv", "400,1\n500,1\n");
  fs::create_symlink(outside.path() + "/a.csv", scenes + "/link.csv");
  fs::create_symlink(outside.path(), scenes + "/door");
  fs::create_symlink("inside.csv", scenes + "/alias.csv");
  const auto error = [&](const std::string& name, bool allow) {
    ReadOptions options;
    options.limits.allow_outside = allow;
    try {
      read_scene_text(with("\"background\": {\"type\": \"file\", \"filename\": \"" + name + "\"}"), "scene.json", scenes, {}, options);
    } catch (const SceneError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string stranger = outside.path() + "/a.csv", up = "../../../" + fs::path(outside.path()).filename().string() + "/a.csv";
  const std::vector<std::string> refused = {stranger, up, "sub/../" + up, "link.csv", "door/a.csv", "../../project2/a.csv"};
  for (const std::string& name : refused) {
    EXPECT_THAT(error(name, false), testing::EndsWith("lies outside the scene's folder, its parent and the working folder (--allow-outside permits it)")) << name;
    EXPECT_EQ(error(name, true), "") << name;
  }
  // Not even whether they exist is told.
  for (const std::string name : {"/etc/passwd", "/no/such/file", "../../../no/such/file"}) EXPECT_THAT(error(name, false), testing::HasSubstr("--allow-outside")) << name;
  for (const std::string& name : {std::string("inside.csv"), std::string("sub/../inside.csv"), std::string("alias.csv"), std::string("../spectra/beside.csv"),
                                  scenes + "/inside.csv", project + "/spectra/beside.csv"})
    EXPECT_EQ(error(name, false), "") << name;
  const fs::path before = fs::current_path();
  fs::current_path(outside.path());
  for (const std::string& name : {stranger, up, std::string("link.csv")}) EXPECT_EQ(error(name, false), "") << name;
  fs::current_path("/");
  EXPECT_NE(error(stranger, false), "");
  fs::current_path(before);
  EXPECT_THAT(error("/dev/zero", true), testing::EndsWith("/dev/zero is no regular file"));
}

TEST(SceneFiles, OnlyRegularOnes) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder.path() + "/pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder.path() + "/folder");
  const auto error = [&](const std::string& name) { return folder.error_of(with("\"background\": {\"type\": \"file\", \"filename\": \"" + name + "\"}")); };
  EXPECT_THAT(error("pipe"), testing::EndsWith("pipe is no regular file"));
  EXPECT_THAT(error("folder"), testing::EndsWith("folder is a folder"));
  EXPECT_THAT(error("a\\u0000b"), testing::EndsWith("the file name has a character 0"));
  EXPECT_NE(error(std::string(5000, 'a')), "");
  EXPECT_LT(error(std::string(5000, 'a')).size(), 1100u);
}

// By their first bytes, whatever they are called: a film's or a font's reader is never tried.
TEST(SceneFiles, OnlyTheIntendedImageReaders) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& name) { return folder.error_of(with("\"background\": {\"type\": \"environment\", \"filename\": \"" + name + "\"}")); };
  const std::string ppm("P6 2 1 255\n\x01\x02\x03\x04\x05\x06", 17);
  folder.file("film.mp4", ppm);
  EXPECT_EQ(error("film.mp4"), "");
  folder.file("a.png", "GIF89a and so on, which OpenImageIO could read");
  EXPECT_THAT(error("a.png"), testing::EndsWith("it is none of PNG, JPEG, OpenEXR, HDR, TIFF, PNM, BMP and Targa"));
  folder.file("a.null", "");
  EXPECT_THAT(error("a.null"), testing::EndsWith("it is none of PNG, JPEG, OpenEXR, HDR, TIFF, PNM, BMP and Targa"));
}

// Faults elsewhere are told before a mesh takes its seconds.
TEST(SceneLimits, AHeaderClaimsNoMoreThanTheFileCanHold) {
  const TemporaryFolder folder;
  folder.file("small.ppm", "P6 16000 16000 255\n");
  EXPECT_THAT(folder.error_of(with(R"("background": {"type": "environment", "filename": "small.ppm"})")),
              testing::EndsWith("its header says 16000x16000 pixels, and the file has 19 bytes"));
}

TEST(SceneLimits, MeshesComeLast) {
  ReadOptions options;
  int calls = 0;
  options.before_meshes = [&](const SceneDescription& scene) {
    calls++;
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[0].mesh->triangles.size(), 1u);
    EXPECT_FALSE(scene.surfaces[0].mesh->masks.empty());
    throw SceneError("enough");
  };
  const std::string head = R"({"type": "mesh", "generator": "head", "resolution": 0.4, "material": {"type": "metal"}})", quad = R"({"type": "quad", "material": {"type": "metal"}})";
  EXPECT_THROW(read_scene_text(with("\"surfaces\": [" + head + ", " + quad + "]"), "scene.json", "", {}, options), SceneError);
  EXPECT_EQ(calls, 1);
  // A broken file is told before meshes that take longer.
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "b.obj"}) folder.file(name, "v 0 0 0\n");
  const std::string late = R"({"type": "mesh", "filename": "a.obj", "offset": -0.1, "offset method": "distance field", "material": {"type": "metal"}})",
                    soon = R"({"type": "mesh", "filename": "b.obj", "material": {"type": "metal"}})";
  EXPECT_THAT(folder.error_of(with("\"surfaces\": [" + late + ", " + soon + "]")), testing::EndsWith("/surfaces/1/filename: " + folder.path() + "/b.obj holds no faces"));
  EXPECT_THAT(error_of(with("\"surfaces\": [" + head + R"(, {"type": "quad"}])")), testing::EndsWith("/surfaces/1: a quad needs \"material\""));
}

}  // namespace
}  // namespace stokes
