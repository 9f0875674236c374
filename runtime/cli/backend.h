// One face for the CPU reference and an OpenCL device, so that commands render without knowing which it is.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiled/compiled_scene.h"
#include "device/renderer.h"
#include "image/film.h"

namespace stokes {

/// Where to render: the reference, or an OpenCL device.
struct DeviceChoice {
  bool reference = false;
  DeviceInfo info;
  std::string name() const { return reference ? "reference" : info.name; }
  std::string driver() const;
  int bvh_width() const { return reference ? 8 : default_bvh_width(info); }
};
/// `spec` as in --device. Throws DeviceError.
DeviceChoice find_backend(const std::string& spec, std::uint64_t need_bytes = 0);

struct BackendOptions {
  int threads = 0;  ///< 0: all
  std::string kernel_dir;
  bool optimise = true, use_cache = true;  ///< as in DeviceOptions
};

struct BackendProgress {
  std::uint64_t samples_done = 0;  ///< pixel samples of this call
  RenderCounters counters;         ///< of all calls
};

class Backend {
 public:
  virtual ~Backend() = default;
  /// Adds the samples [begin, end) of every pixel to the film. `progress` returns false to stop; returns the end of the samples done.
  virtual int render(Film& film, std::uint32_t seed, int begin, int end, const std::function<bool(const BackendProgress&)>& progress) = 0;
  /// To be called after the scene's header got another camera (see look_from).
  virtual void camera_moved() {}
  virtual RenderCounters counters() const = 0;  ///< zeros from the reference, which does not count
  virtual double build_seconds() const { return 0; }
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// Prepares the scene on the chosen device (uploading it, building kernels). The scene must outlive the result.
std::unique_ptr<Backend> make_backend(const CompiledScene& scene, const DeviceChoice& choice, const BackendOptions& options);

}  // namespace stokes
