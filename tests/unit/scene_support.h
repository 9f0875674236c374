// Short scenes for the tests of the scene reader. Knows the reader's front door only.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scene/read_scene.h"

namespace stokes {

/// Reads `text` as scene.json of a folder without files.
inline SceneDescription parse(const std::string& text, const SceneOverrides& overrides = {}) {
  return read_scene_text(text, "scene.json", "/nonexistent", overrides);
}

/// The one line that reading `text` fails with; empty when it does not fail.
inline std::string error_of(const std::string& text, const SceneOverrides& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// A scene whose only top-level key beside the camera is `member`.
inline std::string with(const std::string& member) { return "{\"camera\": {},\n" + member + "}"; }
/// The first surface of a scene of one surface.
inline SurfaceDescription surface(const std::string& json) { return parse(with("\"surfaces\": [" + json + "]")).surfaces.at(0); }
inline MaterialDescription material(const std::string& json) { return *surface(R"({"type": "quad", "material": )" + json + "}").material; }
inline Spectrum background(const std::string& json) { return *parse(with("\"background\": " + json)).background.emission; }
inline MediumDescription medium(const std::string& json) {
  return *surface(R"({"type": "quad", "material": {"type": "interface"}, "inside": )" + json + "}").inside;
}

/// A folder that is gone at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() / ("stokes-scene-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string path() const { return path_.string(); }
  /// Reads a scene that lies in this folder.
  SceneDescription read(const std::string& text) const { return read_scene_text(text, "scene.json", path()); }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

}  // namespace stokes
