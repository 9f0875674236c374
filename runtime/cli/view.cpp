// `stokes view`: a live page on this machine. Knows options, files and devices; the session and the page are runtime/view's.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

#include "cli/commands.h"
#include "cli/display.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/scene_hash.h"
#include "cli/view_film.h"
#include "compiled/look_from.h"
#include "image/error.h"
#include "image/replace_file.h"
#include "view/server.h"
#include "view/watch.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

constexpr int kPort = 7280;  // the shortest and the longest wavelength's first digits
constexpr auto kPoll = std::chrono::milliseconds(100);

struct ViewOptions {
  std::string scene, output, spectral, display_server;
  SceneOptions scene_options;
  std::optional<int> port;
  bool quiet = false;
};

class DeviceScene : public ViewScene {
 public:
  DeviceScene(const ViewOptions& o, const SpectralBins& bins, bool quiet)
      : options_(o.scene_options),
        scene_(load_scene(o.scene, o.scene_options, [&](const SceneDescription& s) { return view_film(s, bins); }, quiet)),
        hash_(scene_.hash) {}

  const CompiledScene& compiled() const override { return scene_.compiled; }
  const CameraDescription& camera() const override { return scene_.description.camera; }
  std::string hash() const override { return hash_; }
  std::string device() const override { return scene_.device.name(); }
  std::vector<std::string> files() const override {
    std::vector<std::string> files = scene_.description.files;
    files.push_back(scene_.path);
    return files;
  }
  std::vector<std::string> warnings() const override { return scene_.compiled.warnings; }
  double prepare() override {
    backend_ = make_backend(scene_.compiled, scene_.device, {options_.threads, options_.kernel_dir});
    for (const std::string& warning : backend_->warnings()) scene_.compiled.warnings.push_back(warning);
    return backend_->build_seconds();
  }
  void look(const CameraDescription& camera) override {
    scene_.compiled.header = look_from(scene_.compiled, camera);
    // Coarse previews are never saved, and hashing a large scene takes longer than they do.
    if (camera.width == scene_.description.camera.width) scene_.hash = scene_hash(scene_.compiled);
    backend_->camera_moved();
  }
  FilmRecord empty_record() const override { return scene_.empty_record(scene_.whole()); }
  int render(Film& film, int begin, int end, const std::function<bool(std::uint64_t)>& go_on) override {
    return backend_->render(film, scene_.compiled.seed, begin, end, [&](const BackendProgress& p) { return go_on(p.samples_done); });
  }

 private:
  SceneOptions options_;
  LoadedScene scene_;
  std::string hash_;  // of the file's own camera
  std::unique_ptr<Backend> backend_;
};

/// Where a picture goes: the output's name with the format's extension.
std::string path_for(const ViewOptions& o, const std::string& format) { return fs::path(o.output).replace_extension("." + format).string(); }

std::string write_picture(const std::string& path, const FilmRecord& record, double exposure) {
  OutputOptions output;
  output.path = path;
  output.exposure = exposure;
  output.variance = true;
  return write_outputs(record, output).front();
}

/// A file's bytes by way of a folder of its own, because the image library writes files.
std::string picture_bytes(const FilmRecord& record, const std::string& format, double exposure) {
  std::string folder = (fs::temp_directory_path() / "stokes-view-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw OutputError(folder + ": cannot be created");
  std::ostringstream bytes;
  try {
    bytes << std::ifstream(write_picture(folder + "/picture." + format, record, exposure), std::ios::binary).rdbuf();
  } catch (...) {
    fs::remove_all(folder);
    throw;
  }
  fs::remove_all(folder);
  return bytes.str();
}

/// Listens where the options say; the usual port may be another viewer's, a port that was asked for may not.
int listen(ViewServer& server, const ViewOptions& o) {
  int port = server.start(o.port.value_or(kPort));
  if (port == 0 && !o.port) port = server.start(0);
  if (port == 0) throw OutputError("--port: 127.0.0.1:" + std::to_string(o.port.value_or(0)) + " is in use, or not allowed");
  return port;
}

int run_view(ViewOptions o) {
  const SpectralBins bins = o.spectral.empty() ? SpectralBins{} : parse_spectral(o.spectral);
  if (o.output.empty()) o.output = fs::path(o.scene).stem().string() + ".exr";
  output_format(o.output);
  require_writable(o.output);
  catch_interrupts();
  auto scene = std::make_unique<DeviceScene>(o, bins, o.quiet);
  DisplayFeed display = open_display(o.display_server, fs::path(o.scene).filename().string());

  FileWatch watch;
  watch.watch(scene->files());
  Session session(std::move(scene), [&o, bins] { return std::make_unique<DeviceScene>(o, bins, true); }, display);
  SaveFormats formats;
  formats.bytes = picture_bytes;
  formats.write = [&o](const FilmRecord& record, const std::string& format, double exposure) {
    return fs::absolute(write_picture(path_for(o, format), record, exposure)).string();
  };
  ViewServer server(session, formats, fs::path(o.scene).stem().string());
  const int port = listen(server, o);
  std::cout << "http://127.0.0.1:" << port << "/" << std::endl;
  if (!o.quiet) std::fprintf(stderr, "on %s; edits of %s are shown as they are saved; Ctrl-C ends\n", session.state().device.c_str(), o.scene.c_str());
  while (!interrupted()) {
    std::this_thread::sleep_for(kPoll);
    watch.watch(session.files());
    if (watch.changed()) session.reload();
  }
  server.stop();
  return kExitDone;
}

}  // namespace

Command add_view(CLI::App& root) {
  auto o = std::make_shared<ViewOptions>();
  CLI::App* app = root.add_subcommand("view", "Renders a scene in a live page on this machine: look around, read spectra, edit the scene file");
  app->add_option("scene", o->scene, "SCENE.json")->required();
  app->add_option("--port", o->port, "Port on 127.0.0.1; 0 is any free one [7280, or a free one]")->check(CLI::Range(0, 65535));
  app->add_option("-o,--output", o->output, "Where the page saves: OUT.exr, and OUT.png [the scene's name, in this folder]");
  o->scene_options.add_to(*app);
  app->add_option("--spectral", o->spectral, "a:b:n: the bins of the spectra [280:780:50, fewer for large pictures]");
  app->add_option("--display-server", o->display_server, "HOST:PORT of a tev viewer that shall show the picture, too [none]");
  app->add_flag("-q,--quiet", o->quiet, "No messages but errors");
  return {app, [o] { return run_view(*o); }};
}

}  // namespace stokes
