// Scene files to descriptions: the library's front door. The format is described in scenes/README.md.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "input/limits.h"
#include "scene/description.h"

namespace stokes {

/// `--set POINTER=VALUE` pairs, applied to the JSON before it is read. A value is JSON, or failing that a string.
using SceneOverrides = std::vector<std::pair<std::string, std::string>>;

struct ReadOptions {
  InputLimits limits;
  /// Called once when some meshes are about to take seconds, with the scene as far as it is known: in place of those meshes stand single
  /// triangles as large. What it throws ends the reading, so that a fault elsewhere is told at once.
  std::function<void(const SceneDescription&)> before_meshes;
};

/// Reads a scene file with every file that it names. Throws SceneError.
SceneDescription read_scene(const std::string& path, const SceneOverrides& overrides = {}, const ReadOptions& options = {});

/// Reads a scene from text. Messages call it `file_name`; files it names are looked for in `directory`.
SceneDescription read_scene_text(const std::string& text, const std::string& file_name, const std::string& directory,
                                 const SceneOverrides& overrides = {}, const ReadOptions& options = {});

}  // namespace stokes
