// Mitsuba's conventions, as its documentation has them or as its pictures show.
#include <numbers>

#include "import_support.h"

namespace stokes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ImportMitsuba : public ImportTest {
 protected:
  /// What follows "file:" of the error that the import ends with; empty when there is none.
  std::string mitsuba_error(const std::string& text) const {
    try {
      mitsuba(text);
    } catch (const ImportError& error) {
      return std::string(error.what()).substr(folder_.string().size() + std::string("/scene.xml:").size());
    }
    return "";
  }
  static std::vector<std::string> texts(const ImportedScene& scene) {
    std::vector<std::string> all;
    for (const ImportedScene::Note& note : scene.notes) all.push_back(note.message);
    return all;
  }
};

const std::string kSensor = "<sensor type=\"perspective\"><float name=\"fov\" value=\"45\"/></sensor>";
const std::string kCornerObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0.25\nf 1/1 2/1 3/1\nf 1/1 4/1 2/1\n";

TEST_F(ImportMitsuba, TheAngleOfViewIsGivenByAxisOrFocalLength) {
  const auto vertical = [&](const std::string& text, int width, int height) {
    const std::string film = "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + std::to_string(width) + "\"/><integer name=\"height\" value=\"" +
                             std::to_string(height) + "\"/><rfilter type=\"box\"/></film>";
    const ImportedScene scene = mitsuba("<sensor type=\"perspective\">" + text + film + "</sensor>");
    EXPECT_TRUE(scene.notes.empty());
    return std::tan(scene.json["camera"]["vfov"].get<double>() * std::numbers::pi / 360);
  };
  const std::string fov = "<float name=\"fov\" value=\"60\"/><string name=\"fov_axis\" value=\"";
  const double t = std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(vertical("<float name=\"fov\" value=\"60\"/>", 400, 300), t * 0.75, 1e-9);
  EXPECT_NEAR(vertical(fov + "x\"/>", 400, 300), t * 0.75, 1e-9);
  EXPECT_NEAR(vertical(fov + "y\"/>", 400, 300), t, 1e-9);
  EXPECT_NEAR(vertical(fov + "diagonal\"/>", 400, 300), t * 0.6, 1e-9);
  EXPECT_NEAR(vertical(fov + "smaller\"/>", 400, 300), t, 1e-9);
  EXPECT_NEAR(vertical(fov + "larger\"/>", 400, 300), t * 0.75, 1e-9);
  EXPECT_NEAR(vertical(fov + "smaller\"/>", 300, 400), t * 4 / 3, 1e-9);
  // A film of 36 by 24 mm seen along the diagonal; a lens of 50 mm where nothing is said.
  const double diagonal = std::hypot(18, 12);
  EXPECT_NEAR(vertical("", 400, 300), diagonal / 50 * 0.6, 1e-9);
  EXPECT_NEAR(vertical("<string name=\"focal_length\" value=\"28mm\"/>", 400, 300), diagonal / 28 * 0.6, 1e-9);
  EXPECT_NEAR(vertical("<string name=\"focal_length\" value=\"28\"/>", 300, 300), diagonal / 28 / std::sqrt(2), 1e-9);
}

TEST_F(ImportMitsuba, AnAngleThatIsNoneIsRefused) {
  const auto sensor = [&](const std::string& text) { return "<sensor type=\"perspective\">" + text + "</sensor>"; };
  EXPECT_THROW(mitsuba(sensor("<float name=\"fov\" value=\"0\"/>")), ImportError);
  EXPECT_THROW(mitsuba(sensor("<float name=\"fov\" value=\"40\"/><string name=\"focal_length\" value=\"28mm\"/>")), ImportError);
  EXPECT_THROW(mitsuba(sensor("<float name=\"fov\" value=\"40\"/><string name=\"fov_axis\" value=\"z\"/>")), ImportError);
  EXPECT_THROW(mitsuba(sensor("<string name=\"focal_length\" value=\"long\"/>")), ImportError);
}

TEST_F(ImportMitsuba, IncludesDefaultsAliasesAndIdsAnywhere) {
  write("sub/part.xml", "<scene version=\"3.0.0\">\n<default name=\"r\" value=\"3\"/><bsdf type=\"twosided\" id=\"both\"><bsdf type=\"diffuse\" id=\"red\"/></bsdf>\n"
                         "<shape type=\"obj\"><string name=\"filename\" value=\"corner.obj\"/></shape>\n<emitter type=\"spot\"/></scene>");
  write("sub/corner.obj", kCornerObj);
  const ImportedScene scene = mitsuba(kSensor + "<default name=\"r\" value=\"2\"/><default name=\"s\" value=\"$r\"/><include filename=\"sub/part.xml\"/>"
                                                "<alias id=\"red\" as=\"rouge\"/><shape type=\"sphere\"><float name=\"radius\" value=\"$s\"/><ref id=\"rouge\"/></shape>");
  ASSERT_THAT(scene.json["surfaces"], SizeIs(2));
  EXPECT_EQ(scene.json["surfaces"][0]["type"], "mesh");
  EXPECT_EQ(scene.json["surfaces"][1]["radius"], 2) << "the first default of a name counts";
  EXPECT_EQ(scene.json["surfaces"][1]["material"]["type"], "lambertian");
  ASSERT_THAT(scene.notes, SizeIs(1));
  EXPECT_THAT(scene.notes[0].text(), HasSubstr("part.xml:4: note: <emitter type=\"spot\">"));
  EXPECT_THAT(mitsuba_error(kSensor + "\n<include filename=\"gone.xml\"/>"), HasSubstr("2: error: "));
  write("round.xml", "<scene version=\"3.0.0\"><include filename=\"round.xml\"/></scene>");
  EXPECT_THROW(mitsuba("<include filename=\"round.xml\"/>"), ImportError);
  EXPECT_THAT(mitsuba_error("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"), testing::StartsWith("2: error: there is already"));
}

TEST_F(ImportMitsuba, OnlyTheFirstSensorIsTaken) {
  const ImportedScene scene = mitsuba(kSensor + "\n<sensor type=\"perspective\"><float name=\"fov\" value=\"10\"/></sensor>");
  EXPECT_GT(scene.json["camera"]["vfov"].get<double>(), 30);
  ASSERT_THAT(scene.notes, SizeIs(1));
  EXPECT_EQ(scene.notes[0].line, 2);
}

TEST_F(ImportMitsuba, AnOrthographicSensorSeesTwoUnitsAcross) {
  const ImportedScene scene = mitsuba("<sensor type=\"orthographic\"><film type=\"hdrfilm\"><integer name=\"width\" value=\"300\"/><integer name=\"height\" value=\"150\"/>"
                                      "<rfilter type=\"box\"/></film></sensor>");
  EXPECT_EQ(scene.json["camera"]["type"], "orthographic");
  EXPECT_EQ(scene.json["camera"]["height"], 1);
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST_F(ImportMitsuba, TransformsThatAreNoneAreRefusedAtTheirLine) {
  const auto error = [&](const std::string& step) { return mitsuba_error("<shape type=\"sphere\"><transform name=\"to_world\">\n" + step + "</transform></shape>"); };
  EXPECT_EQ(error("<matrix value=\"1 0 0 0 1 0 0 0 1\"/>"), "");
  for (const char* step : {"<translate value=\"1,2\"/>", "<translate x=\"1 2\"/>", "<scale value=\"nan\"/>", "<matrix value=\"1 2 3\"/>", "<rotate angle=\"3\"/>",
                           "<lookat origin=\"0,0,0\" target=\"0,1,0\" up=\"0,1,0\"/>"})
    EXPECT_THAT(error(step), testing::StartsWith("2: error: ")) << step;
  EXPECT_THAT(error("<scale x=\"0\"/>"), HasSubstr("singular"));
}

TEST_F(ImportMitsuba, SpectraInAllSpellings) {
  const auto albedo = [&](const std::string& spectrum) { return mitsuba("<bsdf type=\"diffuse\" id=\"b\">\n" + spectrum + "</bsdf>").json["materials"][0]["albedo"]; };
  const ImportJson irregular = albedo("<spectrum name=\"reflectance\" type=\"irregular\"><string name=\"wavelengths\" value=\"400, 500\"/><string name=\"values\" value=\"0.1, 0.5\"/></spectrum>");
  EXPECT_EQ(irregular, (ImportJson{{"type", "sampled"}, {"wavelengths", {400.0, 500.0}}, {"values", {0.1, 0.5}}, {"extrapolate", "zero"}}));
  const ImportJson regular = albedo("<spectrum name=\"reflectance\" type=\"regular\"><float name=\"wavelength_min\" value=\"400\"/><float name=\"wavelength_max\" value=\"600\"/>"
                                    "<string name=\"values\" value=\"0.1 0.5 0.2\"/></spectrum>");
  EXPECT_EQ(regular["wavelengths"], ImportJson({400.0, 500.0, 600.0}));
  write("x.spd", "400 0.1\n500 0.5\n");
  EXPECT_EQ(albedo("<spectrum name=\"reflectance\" filename=\"x.spd\"/>")["extrapolate"], "zero");
  EXPECT_NEAR(albedo("<rgb name=\"reflectance\" value=\"#ff8000\"/>")[1].get<double>(), 0.2158605, 1e-6);
  for (const char* value : {"#gg8040", "#fff", "#ff80001", "1 2"})
    EXPECT_THAT(mitsuba_error("<bsdf type=\"diffuse\">\n</bsdf><shape type=\"sphere\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + std::string(value) + "\"/></bsdf></shape>"),
                testing::StartsWith("2: error: expected"));
}

// Compared with Mitsuba's pictures: it has the first row of an image at v = 0, and our quads and meshes at v = 1.
TEST_F(ImportMitsuba, ImagesStandAsTheyDoThere) {
  write("a.png", "");
  write("corner.obj", kCornerObj);
  const std::string image = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" value=\"a.png\"/></texture></bsdf>";
  const ImportedScene scene = mitsuba("<shape type=\"rectangle\">" + image + "</shape><shape type=\"rectangle\"/>" + "<shape type=\"cube\"/>" +
                                      "<shape type=\"obj\"><string name=\"filename\" value=\"corner.obj\"/><boolean name=\"flip_tex_coords\" value=\"false\"/></shape>"
                                      "<shape type=\"obj\"><string name=\"filename\" value=\"corner.obj\"/></shape>");
  expect_vector(map_of(scene.json["surfaces"][0]).vector({1, 1, 1}), {1, -1, 1});
  EXPECT_FALSE(scene.json["surfaces"][1].contains("transform"));
  for (const ImportJson& face : scene.json["surfaces"][2]["children"]) {
    const auto column = [&](const char* key) { return Vec3d{face["transform"][key][0].get<double>(), face["transform"][key][1].get<double>(), face["transform"][key][2].get<double>()}; };
    expect_vector(cross(column("x"), column("y")), column("z"));
    expect_vector(column("o"), column("z"));
  }
  ASSERT_THAT(scene.meshes, SizeIs(2));
  EXPECT_DOUBLE_EQ(scene.meshes[0].second.uvs[0][1], 0.75);
  EXPECT_DOUBLE_EQ(scene.meshes[1].second.uvs[0][1], 0.25);
}

// Compared with Mitsuba's pictures.
TEST_F(ImportMitsuba, MeshesWithoutNormalsAreSmoothUnlessTheyShallBeFaceted) {
  write("corner.obj", kCornerObj);
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  const auto mesh = [](const std::string& file, const std::string& more) { return "<shape type=\"obj\"><string name=\"filename\" value=\"" + file + "\"/>" + more + "</shape>"; };
  const std::string facets = "<boolean name=\"face_normals\" value=\"true\"/>", mirror = "<transform name=\"to_world\"><scale x=\"-1\"/></transform>";
  const ImportedScene scene = mitsuba(kSensor + mesh("corner.obj", "") + mesh("corner.obj", facets) + mesh("flat.obj", "") + mesh("flat.obj", facets) + mesh("corner.obj", mirror) + mesh("flat.obj", mirror));
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_THAT(scene.meshes, SizeIs(3));
  // The faces of the corner at the origin look along z and y, and both have a right angle there.
  const auto& n = scene.meshes[0].second.normals;
  ASSERT_THAT(n, SizeIs(4));
  expect_vector({n[0][0], n[0][1], n[0][2]}, {0, std::sqrt(0.5), std::sqrt(0.5)});
  expect_vector({n[2][0], n[2][1], n[2][2]}, {0, 0, 1});
  EXPECT_EQ(scene.json["surfaces"][1]["filename"], "corner.obj");
  EXPECT_EQ(scene.json["surfaces"][2]["filename"], "flat.obj");
  EXPECT_THAT(scene.meshes[1].second.normals, IsEmpty());
  // A mirrored mesh is turned inside out where its normals come from its winding.
  EXPECT_EQ(scene.json["surfaces"][4].value("flip", false), true);
  expect_vector({scene.meshes[2].second.normals[0][0], scene.meshes[2].second.normals[0][1], scene.meshes[2].second.normals[0][2]}, {0, std::sqrt(0.5), std::sqrt(0.5)});
  EXPECT_FALSE(scene.json["surfaces"][5].contains("flip"));
}

TEST_F(ImportMitsuba, InstancesAreGroupsAndMirroredSpheresLookInwards) {
  const ImportedScene scene = mitsuba("<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/><shape type=\"cube\"/></shape>"
                                      "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\"><translate x=\"3\"/></transform></shape><shape type=\"instance\"><ref id=\"g\"/></shape>"
                                      "<shape type=\"sphere\"><transform name=\"to_world\"><scale z=\"-1\"/></transform></shape>");
  ASSERT_THAT(scene.json["surfaces"], SizeIs(3));
  EXPECT_THAT(scene.json["surfaces"][0]["children"], SizeIs(2));
  expect_vector(map_of(scene.json["surfaces"][0]).point({0, 0, 0}), {3, 0, 0});
  EXPECT_TRUE(scene.json["surfaces"][2]["flip"].get<bool>());
  EXPECT_THAT(mitsuba_error("<shape type=\"instance\"><ref id=\"g\"/></shape>"), HasSubstr("no shape group"));
}

TEST_F(ImportMitsuba, LampsByIdAndByImage) {
  write("a.png", "");
  const ImportedScene scene = mitsuba(kSensor + "<emitter type=\"area\" id=\"lamp\"><rgb name=\"radiance\" value=\"3\"/></emitter><shape type=\"sphere\"><ref id=\"lamp\"/></shape>"
                                      "<shape type=\"rectangle\"><emitter type=\"area\"><texture type=\"bitmap\" name=\"radiance\"><string name=\"filename\" value=\"a.png\"/></texture></emitter></shape>");
  EXPECT_EQ(scene.json["surfaces"][0]["emit"], ImportJson({3.0, 3.0, 3.0}));
  EXPECT_EQ(scene.json["surfaces"][1]["material"]["type"], "diffuse_light");
  EXPECT_FALSE(scene.json["surfaces"][1].contains("emit"));
  EXPECT_THAT(texts(scene), ElementsAre(HasSubstr("equal energy")));
}

// Mitsuba leaves a ray's medium as it is at a shape without media of its own; vacuum there would lose the fog at the first reflection.
TEST_F(ImportMitsuba, AShapeWithoutMediaStandsInTheOneAroundIt) {
  const std::string fog = "<medium type=\"homogeneous\" id=\"fog\"/>", null = "<bsdf type=\"null\"/><ref name=\"interior\" id=\"fog\"/>";
  const auto at = [](const std::string& shape, double x, const std::string& more = "") {
    return "\n<shape type=\"" + shape + "\">" + more + "<transform name=\"to_world\"><translate x=\"" + std::to_string(x) + "\"/></transform></shape>";
  };
  const std::string large = "<float name=\"radius\" value=\"4\"/>";
  for (const std::string& boundary : {at("sphere", 0, null + large), "<shape type=\"cube\">" + null + "<transform name=\"to_world\"><scale value=\"4\"/></transform></shape>"}) {
    const ImportedScene scene = mitsuba(kSensor + fog + boundary + at("sphere", 1) + at("rectangle", 0.5) + at("sphere", 20) + at("sphere", 4.2));
    const ImportJson& surfaces = scene.json["surfaces"];
    for (const std::size_t inside : {1u, 2u}) {
      EXPECT_EQ(surfaces[inside]["inside"], "fog") << inside;
      EXPECT_EQ(surfaces[inside]["outside"], "fog") << inside;
    }
    EXPECT_FALSE(surfaces[3].contains("outside"));
    ASSERT_THAT(scene.notes, SizeIs(1)) << "the last ball crosses the boundary";
    EXPECT_THAT(scene.notes[0].message, HasSubstr("stands in several"));
    EXPECT_EQ(scene.json.dump().find("(place)"), std::string::npos);
  }
}

}  // namespace
}  // namespace stokes
