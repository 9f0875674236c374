// One value of a scene's JSON and what surrounds it, for the readers of files that a scene names: they are called by themselves, since
// reading a scene around them takes many times as long. Knows nothing of the files.
#pragma once
#include <string>

#include "fuzz/scratch_file.h"
#include "scene/read_context.h"

namespace stokes::fuzz {

/// The JSON is parsed once; every input gets a scene of its own.
class LoneNode {
 public:
  explicit LoneNode(const std::string& json) : source_(parse_json(json, "scene.json")) {
    limits_.allow_outside = true;               // which folder the file lies in is the target's choice
    limits_.memory = std::uint64_t{1} << 30;    // not what the machine has: a run must not depend on that, nor ask for it
  }
  JsonNode node() const { return JsonNode(source_); }
  /// A scene that nothing has been read into yet, whose folder is that of scratch files. `scene` must outlive the context.
  ReadContext context(SceneDescription& scene) const {
    scene.directory = scratch_folder();
    return ReadContext{scene, limits_};
  }

 private:
  JsonSource source_;
  InputLimits limits_;
};

}  // namespace stokes::fuzz
