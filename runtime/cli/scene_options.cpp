// The options that several commands share: which scene, with which changes, on which device.
#include "cli/scene_options.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/scene_hash.h"
#include "cli/scene_text.h"
#include "cli/version.h"
#include "compiled/memory_estimate.h"
#include "layout.h"
#include "scene/read_scene.h"

namespace stokes {
namespace {

CompileOptions compile_options(const DeviceChoice& device, const AovChoice& aovs, const SpectralBins& bins) {
  CompileOptions options;
  options.bvh_width = device.bvh_width();
  options.film_channels = aovs.channels;
  options.spectral_bins = bins.count;
  options.spectral_begin = bins.begin;
  options.spectral_end = bins.end;
  return options;
}

void override_settings(SceneDescription& scene, const SceneOptions& options) {
  if (options.samples) scene.samples = *options.samples;
  if (options.seed) scene.seed = *options.seed;
  if (!options.size.empty()) std::tie(scene.camera.width, scene.camera.height_pixels) = parse_size(options.size);
  if (!options.integrator.empty()) {
    scene.integrator.kind = parse_integrator(options.integrator);
    scene.integrator.name = options.integrator;
  }
  if (!options.mode.empty()) scene.integrator.mode = options.mode == "rgb" ? ColorMode::Rgb : ColorMode::Spectral;
  if (options.wavelengths_per_path) scene.integrator.wavelengths_per_path = *options.wavelengths_per_path;
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
  command.add_option("--device", device, "reference, auto, gpu, cpu, P:D, or part of a platform's or device's name")
      ->envname("STOKES_DEVICE")
      ->capture_default_str();
  command.add_option("--spp", samples, "Samples per pixel [the scene's, else 16]")->check(CLI::Range(1, 1 << 30));
  command.add_option("--seed", seed, "Seed of the random numbers [the scene's, else 0]");
  command.add_option("--size", size, "WIDTHxHEIGHT of the full image [the scene's]");
  command.add_option("--integrator", integrator, "mis, nee, mats, normals, ao, or a name of the scene format [the scene's, else mis]");
  command.add_option("--mode", mode, "spectral or rgb [the scene's, else spectral]")->check(CLI::IsMember({"spectral", "rgb"}));
  command.add_option("--wavelengths-per-path", wavelengths_per_path, "1, 4 or 8 [the scene's, else 4]")->check(CLI::IsMember({1, 4, 8}));
  command.add_option("--set", settings, "/json/pointer=VALUE: changes a value of the scene file; may be given again")->take_all();
  command.add_option("--threads", threads, "CPU threads; 0 is all")->capture_default_str()->check(CLI::Range(0, 4096));
  add_limits_to(command);
  command.add_option("--kernel-dir", kernel_dir, "Read the kernels from this folder instead of the built-in ones")->check(CLI::ExistingDirectory);
}

void SceneOptions::add_limits_to(CLI::App& command) {
  std::string names;
  for (const LimitName& limit : limit_names())
    names += (names.empty() ? "" : ", ") + std::string(limit.name) + " [" + std::to_string(InputLimits{}.*limit.value) + "]";
  command.add_option("--limit", limits, "NAME=VALUE: how much a scene may ask for; may be given again. K, M and G may follow a number. The names and their values: " + names)
      ->take_all();
  command.add_flag("--allow-outside", allow_outside, "Files that a scene names may lie anywhere, not only in its folder, that one's parent and the working folder")->envname("STOKES_ALLOW_OUTSIDE");
}

InputLimits SceneOptions::input_limits() const {
  InputLimits result;
  result.allow_outside = allow_outside;
  for (const std::string& text : limits) try {
      set_limit(result, text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--limit: ") + error.what());
    }
  return result;
}

Film LoadedScene::empty_film(const PixelWindow& w) const {
  const layout::Scene& h = compiled.header;
  const std::uint64_t words = static_cast<std::uint64_t>(w.x1 - w.x0) * static_cast<std::uint64_t>(w.y1 - w.y0) * h.film_stride;
  require_memory(limits, 2 * 8 * words, "the film");  // once as the sum, once as a device's part
  return make_film(static_cast<int>(h.camera.width), static_cast<int>(h.camera.height), w.x0, w.y0, w.x1 - w.x0, w.y1 - w.y0, h.film_channels,
                   static_cast<int>(h.spectral_bins), static_cast<double>(h.spectral_begin), static_cast<double>(h.spectral_end),
                   static_cast<double>(h.film_quantum), static_cast<double>(h.depth_quantum));
}

FilmRecord LoadedScene::empty_record(const PixelWindow& window) const {
  FilmRecord record;
  const std::string& integrator = description.integrator.name;
  record.identity = {program_version(), hash, std::filesystem::path(path).filename().string(), device.name(),
                     integrator.empty() ? "path tracer mis" : integrator, compiled.seed};
  record.notes = {{"stokes:driver", device.driver()},
                  {"stokes:mode", compiled.features.rgb ? "rgb" : "spectral"},
                  {"stokes:wavelengths_per_path", std::to_string(compiled.wavelengths_per_path)}};
  record.samples_total = compiled.samples;
  record.film = empty_film(window);
  return record;
}

void FilmOptions::add_to(CLI::App& command) {
  command.add_option("--crop", crop, "x0,x1,y0,y1: fractions where all are at most 1, else pixels [whole]");
  command.add_option("--aov", aov, "albedo,normal,depth,variance,fluorescence or all: further channels [none]");
  command.add_option("--spectral", spectral, "a:b:n: n equal bins from a to b nm, beside RGB [none]");
}

AovChoice FilmOptions::aovs() const { return aov.empty() ? AovChoice{} : parse_aovs(aov); }
SpectralBins FilmOptions::bins() const { return spectral.empty() ? SpectralBins{} : parse_spectral(spectral); }
PixelWindow FilmOptions::window(const PixelWindow& whole) const { return crop.empty() ? whole : parse_crop(crop, whole.x1, whole.y1); }

PixelWindow LoadedScene::whole() const {
  return {0, static_cast<int>(compiled.header.camera.width), 0, static_cast<int>(compiled.header.camera.height)};
}

namespace {

SceneOverrides overrides_of(const SceneOptions& options) {
  SceneOverrides overrides;
  for (const std::string& setting : options.settings) overrides.push_back(parse_setting(setting));
  return overrides;
}

/// What read() reads of a scene file or text within the options' limits, with the options' changes, where compiling it finds room.
SceneDescription read_within(const SceneOptions& options, const std::function<SceneDescription(const ReadOptions&)>& read) {
  ReadOptions reading;
  reading.limits = options.input_limits();
  // Whatever compiling finds wrong beside the meshes is told before they are made.
  reading.before_meshes = [&](const SceneDescription& so_far) {
    SceneDescription draft = so_far;
    override_settings(draft, options);
    compile_scene(draft);
  };
  SceneDescription scene = read(reading);
  override_settings(scene, options);
  const MemoryEstimate need = estimate_memory(scene);
  require_memory(reading.limits, need.total(), "the scene (" + need.text() + ")");
  return scene;
}

using FilmChooser = std::function<FilmChoice(const SceneDescription&)>;

LoadedScene load_description(const std::string& path, const std::function<SceneDescription()>& read, const SceneOptions& options, const FilmChooser& choose) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  LoadedScene loaded;
  loaded.path = path;
  loaded.limits = options.input_limits();
  loaded.description = read();
  const auto [aovs, bins] = choose(loaded.description);
  if (bins.count > 0 && loaded.description.integrator.mode == ColorMode::Rgb) throw UsageError("--spectral: there are no wavelengths in rgb mode");
  limit_cpu_threads(options.threads);
  loaded.device = find_backend(options.device);
  loaded.compiled = compile_scene(loaded.description, compile_options(loaded.device, aovs, bins));
  // The first choice could not know the scene's size.
  if (!loaded.device.reference) {
    const layout::Scene& h = loaded.compiled.header;
    const std::uint64_t film = std::uint64_t{h.camera.width} * h.camera.height * h.film_stride * 8;
    const DeviceChoice again = find_backend(options.device, scene_bytes(loaded.compiled) + film);
    if (again.bvh_width() != loaded.device.bvh_width()) loaded.compiled = compile_scene(loaded.description, compile_options(again, aovs, bins));
    loaded.device = again;
  }
  loaded.hash = scene_hash(loaded.compiled);
  loaded.load_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return loaded;
}

}  // namespace

SceneDescription read_with_overrides(const std::string& path, const SceneOptions& options) {
  return read_within(options, [&](const ReadOptions& reading) { return read_scene(path, overrides_of(options), reading); });
}

LoadedScene load_scene_text(const std::string& text, const std::string& name, const std::string& directory, const SceneOptions& options,
                            const AovChoice& aovs, const SpectralBins& bins) {
  const auto read = [&] {
    return read_within(options, [&](const ReadOptions& reading) { return read_scene_text(text, name, directory, overrides_of(options), reading); });
  };
  return load_description(name, read, options, [&](const SceneDescription&) { return FilmChoice{aovs, bins}; });
}

LoadedScene load_scene(const std::string& path, const SceneOptions& options, const AovChoice& aovs, const SpectralBins& bins, bool quiet) {
  return load_scene(path, options, [&](const SceneDescription&) { return FilmChoice{aovs, bins}; }, quiet);
}

LoadedScene load_scene(const std::string& path, const SceneOptions& options, const FilmChooser& choose, bool quiet) {
  LoadedScene loaded = load_description(path, [&] { return read_with_overrides(path, options); }, options, choose);
  if (!quiet)
    for (const std::string& warning : loaded.compiled.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  return loaded;
}

}  // namespace stokes
