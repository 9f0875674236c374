// Fuzzes the scene reader: any bytes give a description or one error line with its place. Meshes are not made; files are not found.
#include "fuzz/checks.h"
#include "scene/read_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  struct Enough {};
  ReadOptions options;
  options.before_meshes = [](const SceneDescription&) { throw Enough{}; };
  try {
    read_scene_text(std::string(reinterpret_cast<const char*>(data), size), "scene.json", "/nonexistent", {}, options);
  } catch (const SceneError& error) {
    fuzz::check_scene_error(error.what(), "scene.json");
  } catch (const Enough&) {
  }
  return 0;
}
