// `stokes import`: a scene of Mitsuba 3 or pbrt-v4 to one of ours, and the list of what was not understood. Knows files and options;
// the formats are runtime/import's.
#include "cli/import.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/exit_codes.h"
#include "image/error.h"
#include "image/replace_file.h"
#include "import/imported_scene.h"
#include "scene/error.h"
#include "scene/read_context.h"
#include "scene/read_scene.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kLineLength = 140;

struct ImportOptions {
  std::string input, output;
  bool strict = false, force = false, allow_outside = false;
};

/// On one line; a file's name, which need not be UTF-8, must not end the import.
std::string flat_text(const ImportJson& j) { return j.dump(-1, ' ', false, ImportJson::error_handler_t::replace); }

/// JSON as people write it: what fits a line stands on one.
std::string pretty(const ImportJson& j, std::size_t indent) {
  const std::string flat = flat_text(j);
  if ((!j.is_object() && !j.is_array()) || (indent > 0 && flat.size() + indent < kLineLength)) return flat;
  std::string text = j.is_object() ? "{" : "[";
  const std::string margin(indent + 2, ' ');
  bool first = true;
  for (const auto& item : j.items()) {
    text += (first ? "\n" : ",\n") + margin + (j.is_object() ? flat_text(item.key()) + ": " : "") + pretty(item.value(), indent + 2);
    first = false;
  }
  return text + "\n" + std::string(indent, ' ') + (j.is_object() ? "}" : "]");
}

ImportedScene read_foreign(const ImportOptions& o, const ImportTarget& target) {
  std::string extension = fs::path(o.input).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".xml") return import_mitsuba(o.input, target);
  if (extension == ".pbrt") return import_pbrt(o.input, target);
  throw UsageError(o.input + " ends in neither .xml (Mitsuba 3) nor .pbrt (pbrt-v4)");
}

void require_new(const std::string& path, bool force) {
  std::error_code error;
  if (!force && fs::exists(fs::symlink_status(path, error))) throw OutputError(path + " exists already; --force overwrites it");
}

int run_import(ImportOptions o) {
  if (o.output.empty()) o.output = fs::path(o.input).stem().string() + ".json";
  if (fs::path(o.output).extension() != ".json") throw UsageError("-o: '" + o.output + "' does not end in .json");
  require_new(o.output, o.force);
  require_writable(o.output);
  const fs::path folder = fs::path(o.output).parent_path();
  ImportedScene scene;
  try {
    scene = read_foreign(o, {folder.string(), fs::path(o.output).stem().string(), o.allow_outside});
  } catch (const ImportError& error) {
    throw SceneError(error.what());
  }
  for (const auto& [name, mesh] : scene.meshes) {
    const std::string path = (folder / name).string();
    require_new(path, o.force);
    std::error_code made;
    fs::create_directories(fs::path(path).parent_path(), made);
    if (made) throw OutputError(fs::path(path).parent_path().string() + " cannot be made: " + made.message());
    write_bytes(path, obj_text(mesh));
    std::printf("%s\n", path.c_str());
  }
  const std::string text = pretty(scene.json, 0) + "\n";
  write_bytes(o.output, text);
  std::printf("%s\n", o.output.c_str());
  for (const auto& note : scene.notes) std::fprintf(stderr, "%s\n", note.text().c_str());
  // What the importer wrote must be a scene; if it is not, the reader says where to mend it.
  bool sound = true;
  try {
    ReadOptions reading;
    reading.limits.allow_outside = true;
    const SceneDescription written = read_scene(o.output, {}, reading);
    for (const std::string& file : written.files)
      if (!lies_where_allowed(file, written.directory))
        std::fprintf(stderr, "%s names %s, so rendering it needs --allow-outside\n", o.output.c_str(), file.c_str());
  } catch (const SceneError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    sound = false;
  }
  if (!scene.notes.empty()) std::fprintf(stderr, "%zu things have no exact counterpart; see above\n", scene.notes.size());
  return sound && (scene.notes.empty() || !o.strict) ? kExitDone : kExitBadInput;
}

}  // namespace

Command add_import(CLI::App& root) {
  auto o = std::make_shared<ImportOptions>();
  CLI::App* app = root.add_subcommand("import", "Makes a scene of one of Mitsuba 3 (.xml) or pbrt-v4 (.pbrt), and lists what has no counterpart");
  app->add_option("file", o->input, "FILE.xml or FILE.pbrt")->required();
  app->add_option("-o,--output", o->output, "SCENE.json [the file's name with .json, in this folder]");
  app->add_flag("--strict", o->strict, "Exit with 2 when anything has no exact counterpart");
  app->add_flag("--force", o->force, "Overwrite the scene");
  app->add_flag("--allow-outside", o->allow_outside, "Files that the scene includes may lie anywhere, not only in its folder, that one's parent and the working folder")->envname("STOKES_ALLOW_OUTSIDE");
  return {app, [o] { return run_import(*o); }};
}

}  // namespace stokes
