// Files of other renderers, written for a test and imported. Knows the importers' front door only.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "import/imported_scene.h"
#include "math/vec.h"

namespace stokes {

/// A folder that is gone after the test.
class ImportTest : public testing::Test {
 protected:
  ImportTest() : folder_(std::filesystem::temp_directory_path() / ("stokes_import_" + std::to_string(getpid()))) { std::filesystem::create_directories(folder_); }
  ~ImportTest() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path.string();
  }
  ImportedScene pbrt(const std::string& text) const { return import_pbrt(write("scene.pbrt", text), {folder_.string(), "scene"}); }
  ImportedScene mitsuba(const std::string& text) const {
    return import_mitsuba(write("scene.xml", "<scene version=\"3.0.0\">" + text + "</scene>"), {folder_.string(), "scene"});
  }
  /// What follows "file:" of the error that the import ends with; empty when there is none.
  std::string pbrt_error(const std::string& text) const {
    try {
      pbrt(text);
    } catch (const ImportError& error) {
      return std::string(error.what()).substr(folder_.string().size() + std::string("/scene.pbrt:").size());
    }
    return "";
  }

  std::filesystem::path folder_;
};

/// The map of a `transform` of the imported scene; of none where it has none.
inline Affine map_of(const ImportJson& thing) {
  Affine a;
  if (thing.contains("transform"))
    for (std::size_t i = 0; i < 12; i++) a.m[i] = thing["transform"]["matrix"][i].get<double>();
  return a;
}

inline void expect_vector(Vec3d actual, Vec3d expected) {
  EXPECT_NEAR(actual.x, expected.x, 1e-9);
  EXPECT_NEAR(actual.y, expected.y, 1e-9);
  EXPECT_NEAR(actual.z, expected.z, 1e-9);
}

}  // namespace stokes
