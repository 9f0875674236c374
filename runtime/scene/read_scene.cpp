// The top level of a scene.
#include "scene/read_scene.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "scene/material_reader.h"
#include "scene/medium_reader.h"
#include "scene/settings_reader.h"
#include "scene/spectrum_reader.h"
#include "scene/surface_reader.h"

namespace stokes {

SceneDescription read_scene_text(const std::string& text, const std::string& file_name, const std::string& directory,
                                 const SceneOverrides& overrides, const ReadOptions& options) {
  JsonSource source = parse_json(text, file_name, options.limits);
  for (const auto& [pointer, value] : overrides) apply_override(source, pointer, value);

  SceneDescription scene;
  scene.source = source.map;
  scene.directory = directory;
  ReadContext context{scene, options.limits};
  const JsonNode root(source);
  if (root.is_object() && root.json().contains("tests") && !root.json().contains("camera"))
    root.child("tests").fail_at_key("a file of tests for darts' own program, not a scene: there is nothing to render");
  const JsonObject o(root, "a scene",
                     {"camera", "sampler", "integrator", "background", "accelerator", "spectra", "media", "materials", "surfaces", "film",
                      "scene unit", "$schema"});
  o.string("$schema", "");

  // What is named comes first, in the order in which names may refer to each other.
  if (const auto unit = o.find("scene unit")) scene.scene_unit = read_length_unit(*unit);
  if (const auto spectra = o.find("spectra")) read_named_spectra(context, *spectra);
  if (const auto media = o.find("media")) read_named_media(context, *media);
  if (const auto materials = o.find("materials")) read_named_materials(context, *materials);

  scene.camera = read_camera(context, o.require("camera"));
  if (const auto sampler = o.find("sampler")) read_sampler(context, *sampler);
  if (const auto integrator = o.find("integrator")) scene.integrator = read_integrator(*integrator);
  if (const auto background = o.find("background")) scene.background = read_background(context, *background);
  if (const auto film = o.find("film")) read_film(context, *film);
  if (const auto surfaces = o.find("surfaces")) read_surfaces(context, *surfaces, options.before_meshes);
  return scene;
}

SceneDescription read_scene(const std::string& path, const SceneOverrides& overrides, const ReadOptions& options) {
  const auto unreadable = [&](const std::string& why) { throw SceneError(path, {1, 1}, "", "the scene cannot be read: " + why); };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) unreadable("it is a folder");
  // One that lies in a folder of scenes would be waited for; a shell's <(...) and /dev/stdin are pipes that somebody writes to.
  const bool of_a_shell = path.starts_with("/dev/") || path.starts_with("/proc/");
  if (!of_a_shell && std::filesystem::is_fifo(path, error)) unreadable("it is a pipe; pipes are read as /dev/stdin");
  std::ifstream file(path, std::ios::binary);
  if (!file) unreadable(std::strerror(errno));
  // The scene itself may be a pipe, whose size shows only at its end.
  std::string text;
  for (char block[1 << 16]; file.read(block, sizeof block), file.gcount() > 0;) {
    text.append(block, static_cast<std::size_t>(file.gcount()));
    if (text.size() > options.limits.scene_bytes)
      unreadable("it has more than " + std::to_string(options.limits.scene_bytes) + " bytes (--limit scene-bytes)");
  }
  if (file.bad()) unreadable(std::strerror(errno));
  return read_scene_text(text, path, std::filesystem::path(path).parent_path().string(), overrides, options);
}

}  // namespace stokes
