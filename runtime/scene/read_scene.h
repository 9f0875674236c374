// Scene files to descriptions: the library's front door. The format is described in scenes/README.md.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/description.h"

namespace stokes {

/// `--set POINTER=VALUE` pairs, applied to the JSON before it is read. A value is JSON, or failing that a string.
using SceneOverrides = std::vector<std::pair<std::string, std::string>>;

/// Reads a scene file with every file that it names. Throws SceneError.
SceneDescription read_scene(const std::string& path, const SceneOverrides& overrides = {});

/// Reads a scene from text. Messages call it `file_name`; files it names are looked for in `directory`.
SceneDescription read_scene_text(const std::string& text, const std::string& file_name, const std::string& directory,
                                 const SceneOverrides& overrides = {});

}  // namespace stokes
