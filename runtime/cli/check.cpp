// `stokes check`: parses and validates scenes, renders nothing.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/scene_options.h"
#include "scene/memory_error.h"

namespace stokes {
namespace {

struct CheckOptions {
  std::vector<std::string> scenes;
  SceneOptions scene_options;
  bool quiet = false;
};

/// One scene, through all that can find a fault without a device. Returns whether it is sound.
bool check_scene(const std::string& path, const CheckOptions& o) {
  try {
    const SceneDescription scene = read_with_overrides(path, o.scene_options);
    const CompiledScene compiled = compile_scene(scene);
    for (const std::string& warning : compiled.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    if (!o.quiet)
      std::printf("%s: ok (%ux%u, %d samples, %zu surfaces, %u quads, %u spheres, %u ellipsoids, %u triangles, %u lights)\n", path.c_str(),
                  compiled.header.camera.width, compiled.header.camera.height, compiled.samples, scene.surfaces.size(),
                  compiled.header.quad_count, compiled.header.sphere_count, compiled.header.ellipsoid_count,
                  compiled.header.triangle_count, compiled.header.light_count);
    return true;
  } catch (const SceneMemoryError&) {
    throw;  // no fault of the scene's
  } catch (const SceneError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return false;
  }
}

int run_check(const CheckOptions& o) {
  bool all_sound = true;
  for (const std::string& path : o.scenes) all_sound &= check_scene(path, o);
  return all_sound ? kExitDone : kExitBadInput;
}

}  // namespace

Command add_check(CLI::App& root) {
  auto o = std::make_shared<CheckOptions>();
  CLI::App* app = root.add_subcommand("check", "Parses and validates scenes");
  app->add_option("scenes", o->scenes, "SCENE.json ...")->required();
  app->add_option("--set", o->scene_options.settings, "/json/pointer=VALUE: changes a value first; may be given again")->take_all();
  o->scene_options.add_limits_to(*app);
  app->add_flag("-q,--quiet", o->quiet, "Only warnings and errors");
  return {app, [o] { return run_check(*o); }};
}

}  // namespace stokes
