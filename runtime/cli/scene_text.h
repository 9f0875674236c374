// Loading of scenes that are no files, such as the Python package's dicts.
#pragma once
#include <string>

#include "cli/scene_options.h"

namespace stokes {

/// `load_scene` for a scene from text, without its output of warnings; messages call it `name`, and files it names are looked for in `directory`.
LoadedScene load_scene_text(const std::string& text, const std::string& name, const std::string& directory, const SceneOptions& options,
                            const AovChoice& aovs, const SpectralBins& bins);

}  // namespace stokes
