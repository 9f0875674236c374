// `stokes new`: a commented scene to begin with, and beside it the schema by which editors complete it. Knows names of files, not
// what stands in them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/starters.h"
#include "image/error.h"
#include "image/replace_file.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

constexpr const char* kSchema = "schema.json";  // the starters' "$schema"

struct NewOptions {
  std::string kind = "box", path;
  bool force = false, no_schema = false;
};

int run_new(NewOptions o) {
  const auto& files = starter_files();
  // `stokes new FILE.json`: the only word is the file.
  if (o.path.empty()) std::swap(o.path, o.kind), o.kind = "box";
  if (!files.count(o.kind + ".json") || o.kind == "schema")
    throw UsageError("there is no starter '" + o.kind + "'; there are box, skin and fluorescent");
  if (files.count(o.path + ".json")) throw UsageError("new needs the name of a file: stokes new " + o.path + " my_scene.json");
  const fs::path schema = fs::path(o.path).parent_path() / kSchema;
  if (fs::path(o.path).filename() == kSchema) throw UsageError(std::string("the scene cannot be called ") + kSchema + ": that is the schema beside it");
  std::error_code error;
  if (!o.force && fs::exists(fs::symlink_status(o.path, error))) throw OutputError(o.path + " exists already; --force overwrites it");
  require_writable(o.path);
  write_bytes(o.path, files.at(o.kind + ".json"));
  std::printf("%s\n", o.path.c_str());
  // A schema that is there is left alone: it may be another program's, or newer.
  if (!o.no_schema && !fs::exists(fs::symlink_status(schema, error))) {
    write_bytes(schema.string(), files.at(kSchema));
    std::printf("%s\n", schema.string().c_str());
  }
  return kExitDone;
}

}  // namespace

Command add_new(CLI::App& root) {
  auto o = std::make_shared<NewOptions>();
  CLI::App* app = root.add_subcommand("new", "Writes a commented scene to begin with, and the schema by which editors complete it");
  app->add_option("kind", o->kind, "box, skin or fluorescent [box]")->required();
  app->add_option("file", o->path, "FILE.json, or .jsonc, which more editors let have comments");
  app->add_flag("--force", o->force, "Overwrite the file");
  app->add_flag("--no-schema", o->no_schema, std::string("Do not write ") + kSchema + " beside it");
  return {app, [o] { return run_new(*o); }};
}

}  // namespace stokes
