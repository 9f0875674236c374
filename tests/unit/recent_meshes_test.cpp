// What stays the same between two readings of a scene is made once, while the first is held.
#include "unit/scene_support.h"

namespace stokes {
namespace {

using testing::HasSubstr;

SceneDescription surfaces(const std::string& json) { return parse(with("\"surfaces\": [" + json + "]")); }

TEST(RecentMeshes, AnEditTakesOverMeshesThatStay) {
  const auto head = [](const std::string& resolution, const std::string& more) {
    return surfaces(R"({"type": "mesh", "generator": "head", "resolution": )" + resolution + more + R"(, "material": {"type": "metal"}})");
  };
  const SceneDescription first = head("10", ""), again = head("10", R"(, "name": "other", "transform": {"scale": 2})"), finer = head("9", ""),
                         larger = head("10", R"(, "offset": 0.1)"), same = head("10", R"(, "offset": 0.1)"),
                         scaled = head("10", R"(, "offset": 0.1, "transform": {"scale": 2})"), turned = head("10", R"(, "parameters": {"pitch": 9})");
  const auto mesh = [](const SceneDescription& scene) { return scene.surfaces.at(0).mesh; };
  EXPECT_EQ(mesh(again), mesh(first));
  EXPECT_EQ(mesh(same), mesh(larger));
  for (const SceneDescription* other : {&finer, &larger, &turned}) EXPECT_NE(mesh(*other), mesh(first));
  EXPECT_NE(mesh(scaled), mesh(larger)) << "an offset is in the scene's units, whatever the transform enlarges";
}

TEST(RecentMeshes, SkinTakesOverItsShell) {
  const TemporaryFolder folder;
  folder.file("tetrahedron.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto skin = [&](const std::string& fraction, const std::string& thickness) {
    return folder.read(with(R"("surfaces": [{"type": "mesh", "filename": "tetrahedron.obj", "material": {"type": "skin", "melanosome fraction": )" + fraction +
                            R"(, "epidermis thickness": )" + thickness + "}}]"));
  };
  const SceneDescription first = skin("0.1", "0.1"), colour = skin("0.3", "0.1"), deeper = skin("0.1", "0.2");
  ASSERT_EQ(first.surfaces.size(), 2u);
  EXPECT_EQ(colour.surfaces[1].mesh, first.surfaces[1].mesh);
  EXPECT_EQ(deeper.surfaces[0].mesh, first.surfaces[0].mesh);
  EXPECT_NE(deeper.surfaces[1].mesh, first.surfaces[1].mesh);
  folder.file("tetrahedron.obj", "v 0 0 0\nv 10 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_NE(skin("0.1", "0.1").surfaces[1].mesh, first.surfaces[1].mesh) << "the shell of another mesh";
}

TEST(RecentMeshes, AChangedFileIsReadAgainAndWarningsAreTold) {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto read = [&](const std::string& more) {
    return folder.read("{" + more + R"("camera": {}, "surfaces": [{"type": "mesh", "filename": "a.obj", "material": {"type": "metal"}}]})");
  };
  folder.file("a.obj", triangle + "f 1 1 2\n");
  const SceneDescription first = read(""), again = read("\n");
  EXPECT_EQ(again.surfaces.at(0).mesh, first.surfaces.at(0).mesh);
  ASSERT_EQ(again.warnings.size(), 1u);
  EXPECT_THAT(again.warnings[0], HasSubstr("1 of 2 triangles have no area"));
  EXPECT_THAT(again.warnings[0], HasSubstr(":2:")) << "where the surface stands now";
  folder.file("a.obj", triangle + "v 1 1 1\nf 1 2 4\n");
  const SceneDescription changed = read("");
  EXPECT_EQ(changed.surfaces.at(0).mesh->triangles.size(), 2u);
  EXPECT_TRUE(changed.warnings.empty());
}

TEST(RecentMeshes, NobodyKeepsWhatNobodyUses) {
  std::weak_ptr<const MeshData> mesh;
  {
    const SceneDescription scene = surfaces(R"({"type": "mesh", "generator": "hand", "resolution": 10, "material": {"type": "metal"}})");
    mesh = scene.surfaces.at(0).mesh;
    EXPECT_FALSE(mesh.expired());
  }
  EXPECT_TRUE(mesh.expired());
}

}  // namespace
}  // namespace stokes
