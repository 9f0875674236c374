// Mitsuba's rules of a perspective sensor's angle, as its documentation of the plugin has them.
#include <numbers>

#include "import_support.h"

namespace stokes {
namespace {

using ImportMitsuba = ImportTest;

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

}  // namespace
}  // namespace stokes
