// Fuzzes the scene reader: any bytes give a sound description or one error line with its place. Heads are not made; files are not found.
#include "fuzz/checks.h"
#include "fuzz/scene_checks.h"
#include "scene/read_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  struct Enough {};
  ReadOptions options;
  options.limits.memory = std::uint64_t{1} << 30;  // not what the machine has: a run must not depend on that, nor ask for it
  options.before_meshes = [](const SceneDescription& scene) {
    fuzz::check_description(scene);
    throw Enough{};
  };
  try {
    const SceneDescription scene = read_scene_text(std::string(reinterpret_cast<const char*>(data), size), "scene.json", "/nonexistent", {}, options);
    fuzz::check_description(scene);
    for (const std::string& warning : scene.warnings) fuzz::check_scene_warning(warning, "scene.json");
  } catch (const SceneError& error) {
    fuzz::check_scene_error(error.what(), "scene.json");
  } catch (const Enough&) {
  }
  return 0;
}
