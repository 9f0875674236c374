// Renders a compiled scene on one OpenCL device. Nothing outside runtime/device includes an OpenCL header.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiled/compiled_scene.h"
#include "image/film.h"

namespace stokes {

struct DeviceInfo {
  int platform = 0, device = 0;  ///< as `clinfo -l` numbers them
  std::string platform_name, name, vendor, version, driver;
  std::string type;              ///< "cpu", "gpu", "accelerator"
  unsigned compute_units = 0;
  std::uint64_t memory_bytes = 0;
  bool usable = true;
  std::string why_not;
};

/// Every device of every platform; platforms without devices are skipped, never an error.
std::vector<DeviceInfo> list_devices();
/// The device that `spec` names ("auto", "gpu", "cpu", "P:D", part of a name). "auto" takes the first GPU with `need_bytes` of memory,
/// else the first such accelerator, else a CPU. Throws DeviceError (also listing the matches when ambiguous).
DeviceInfo choose_device(const std::string& spec, std::uint64_t need_bytes = 0);
/// The same among given devices.
DeviceInfo choose_among(const std::vector<DeviceInfo>& devices, const std::string& spec, std::uint64_t need_bytes = 0);
/// What a scene's arrays take on a device, without the film.
std::uint64_t scene_bytes(const CompiledScene& scene);

/// Limits CPU runtimes that read their thread count from the environment (PoCL, Intel). Only of use before the first call of any other
/// function here; DeviceOptions::threads works later too, but Intel's runtime heeds only this.
void limit_cpu_threads(int threads);

struct RenderCounters {
  std::uint64_t rays = 0, shadow_rays = 0, scatterings = 0, paths = 0, invalid = 0;
  std::uint64_t flights = 0;     ///< from one vertex to the next; not counted with one lane
  std::uint64_t lane_steps = 0;  ///< flights, and those that lanes without a path waited for; depends on lanes and launches
};

struct RenderProgress {
  std::uint64_t samples_done = 0, samples_total = 0;  ///< pixel samples
  double seconds = 0;
  RenderCounters counters;
};

struct DeviceOptions {
  int lanes = 0;              ///< 0: 8 on CPUs, 1 on GPUs
  int threads = 0;            ///< CPU devices: at most so many (0: all)
  std::string kernel_dir;     ///< read kernels from here instead of the embedded ones
  bool optimise = true;
  bool use_cache = true;      ///< false: kernels are built anew, whatever the cache holds
};

class Renderer {
 public:
  /// Uploads the scene and builds the kernels. Throws DeviceError, KernelBuildError.
  Renderer(const CompiledScene& scene, const DeviceInfo& device, const DeviceOptions& options = {});
  ~Renderer();
  /// Adds the samples [begin, end) of every pixel of the film's window to the film. `progress` is called after each launch and returns
  /// false to stop; then the film holds whole sample passes [begin, returned end). Returns the end of the samples done.
  int render_samples(Film& film, std::uint32_t seed, int begin, int end, const std::function<bool(const RenderProgress&)>& progress);
  /// From now on the scene is seen as `header` says (see look_from); no kernel is built for it. Films must be made anew where the header's
  /// resolution or unit of depth differ. Throws std::invalid_argument when the header has another film layout or lights.
  void set_header(const layout::Scene& header);
  const RenderCounters& counters() const;
  double build_seconds() const;
  const DeviceInfo& device() const;
  /// One-line warnings from the build (such as kernels that only built without optimisation); to be shown once.
  const std::vector<std::string>& warnings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The lane width and BVH width that suit a device.
int default_lanes(const DeviceInfo& device);
int default_bvh_width(const DeviceInfo& device);

}  // namespace stokes
