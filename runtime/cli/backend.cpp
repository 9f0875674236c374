// One face for the CPU reference and an OpenCL device, so that commands render without knowing which it is.
#include "cli/backend.h"

#include <algorithm>
#include <thread>

#include "cli/version.h"
#include "reference/reference.h"

namespace stokes {
namespace {

class ReferenceBackend : public Backend {
 public:
  ReferenceBackend(const CompiledScene& scene, int threads)
      : scene_(scene), threads_(threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

  int render(Film& film, std::uint32_t seed, int begin, int end, const std::function<bool(const BackendProgress&)>& progress) override {
    return reference::render_samples(scene_, film, seed, begin, end, threads_, [&](const reference::Progress& p) {
      return progress({p.samples_done, {}});
    });
  }
  RenderCounters counters() const override { return {}; }

 private:
  const CompiledScene& scene_;
  int threads_;
};

class OpenClBackend : public Backend {
 public:
  OpenClBackend(const CompiledScene& scene, const DeviceInfo& device, const DeviceOptions& options)
      : scene_(scene), renderer_(scene, device, options) {}

  int render(Film& film, std::uint32_t seed, int begin, int end, const std::function<bool(const BackendProgress&)>& progress) override {
    return renderer_.render_samples(film, seed, begin, end, [&](const RenderProgress& p) { return progress({p.samples_done, p.counters}); });
  }
  void camera_moved() override { renderer_.set_header(scene_.header); }
  RenderCounters counters() const override { return renderer_.counters(); }
  double build_seconds() const override { return renderer_.build_seconds(); }
  std::vector<std::string> warnings() const override { return renderer_.warnings(); }

 private:
  const CompiledScene& scene_;
  Renderer renderer_;
};

}  // namespace

std::string DeviceChoice::driver() const { return reference ? "stokes " + program_version() : info.driver; }

DeviceChoice find_backend(const std::string& spec, std::uint64_t need_bytes) {
  DeviceChoice choice;
  choice.reference = spec == "reference";
  if (!choice.reference) choice.info = choose_device(spec, need_bytes);
  return choice;
}

std::unique_ptr<Backend> make_backend(const CompiledScene& scene, const DeviceChoice& choice, const BackendOptions& options) {
  if (choice.reference) return std::make_unique<ReferenceBackend>(scene, options.threads);
  DeviceOptions device_options;
  device_options.threads = options.threads;
  device_options.kernel_dir = options.kernel_dir;
  device_options.optimise = options.optimise;
  device_options.use_cache = options.use_cache;
  return std::make_unique<OpenClBackend>(scene, choice.info, device_options);
}

}  // namespace stokes
