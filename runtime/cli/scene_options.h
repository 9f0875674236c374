// The options that several commands share: which scene, with which changes, on which device.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/backend.h"
#include "compiled/compiled_scene.h"
#include "image/film_file.h"
#include "input/limits.h"
#include "scene/description.h"

namespace CLI {
class App;
}

namespace stokes {

/// What overrides the scene file, as given; empty or unset: the file's.
struct SceneOptions {
  std::string device = "auto";
  std::optional<int> samples;
  std::optional<std::uint32_t> seed;
  std::string size;
  std::string integrator;
  std::string mode;
  std::optional<int> wavelengths_per_path;
  std::vector<std::string> settings;
  int threads = 0;
  std::string kernel_dir;
  std::vector<std::string> limits;  ///< "NAME=VALUE"
  bool allow_outside = false;
  void add_to(CLI::App& command);
  /// The options that bound what a scene may ask for, alone.
  void add_limits_to(CLI::App& command);
  /// Throws UsageError.
  InputLimits input_limits() const;
};

/// What a film shall hold beside R, G, B and alpha.
struct FilmChoice {
  AovChoice aovs;
  SpectralBins bins;
};

/// --crop, --aov and --spectral.
struct FilmOptions {
  std::string crop, aov, spectral;
  void add_to(CLI::App& command);
  /// Throw UsageError.
  AovChoice aovs() const;
  SpectralBins bins() const;
  PixelWindow window(const PixelWindow& whole) const;
};

/// A scene ready to render, with what it was made from.
struct LoadedScene {
  std::string path;
  SceneDescription description;
  CompiledScene compiled;
  std::string hash;
  DeviceChoice device;
  double load_seconds = 0;
  InputLimits limits;
  Film empty_film(const PixelWindow& window) const;
  /// A record without samples, with what every output says about its origin.
  FilmRecord empty_record(const PixelWindow& window) const;
  PixelWindow whole() const;
};

/// Reads, overrides and compiles a scene for the device that the options name. Warnings go to stderr unless `quiet`.
/// Throws SceneError, UsageError, DeviceError.
LoadedScene load_scene(const std::string& path, const SceneOptions& options, const AovChoice& aovs, const SpectralBins& bins, bool quiet);

/// Likewise, where the film depends on what the scene holds.
LoadedScene load_scene(const std::string& path, const SceneOptions& options, const std::function<FilmChoice(const SceneDescription&)>& choose, bool quiet);

/// Reads and overrides alone. Throws SceneError, UsageError, and OutOfMemory where compiling the scene would take more than there is.
SceneDescription read_with_overrides(const std::string& path, const SceneOptions& options);

}  // namespace stokes
