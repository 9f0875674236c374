// Runs a kernel of a test's own on an OpenCL device, so that device functions can be compared with the host's on a grid of inputs.
// Keeps OpenCL out of the tests.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "compiled/compiled_scene.h"

namespace stokes::test {

/// One kernel. Its arguments are, in this order: the scene's buffers (SceneView's order) if a scene is given, then what input(), value()
/// and output() name, in the order of the calls. The device is STOKES_DEVICE's, else the automatic one.
class KernelProbe {
 public:
  /// `source` may #include the files of kernels/. `constants` are #define lines; with a scene, the scene's build constants come first.
  /// Throws KernelBuildError (its log() names files and lines; the source itself is "probe.cl") and DeviceError.
  KernelProbe(const std::string& source, const std::string& kernel, const std::string& constants);
  KernelProbe(const std::string& source, const std::string& kernel, const CompiledScene& scene, int lanes, const std::string& constants = "");
  ~KernelProbe();

  template <typename Item>
  KernelProbe& input(const std::vector<Item>& items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    add_buffer(items.data(), items.size() * sizeof(Item), false);
    return *this;
  }
  /// A buffer of `count` zeroed items that the kernel writes, read by result() in the order of the calls.
  template <typename Item>
  KernelProbe& output(std::size_t count) {
    const std::vector<Item> zeros(count);
    add_buffer(zeros.data(), count * sizeof(Item), true);
    return *this;
  }
  template <typename Item>
  KernelProbe& value(const Item& item) {
    add_value(&item, sizeof item);
    return *this;
  }
  /// Runs `work_items` work-items of local size 1 and waits.
  KernelProbe& run(std::size_t work_items);
  /// The `index`-th output.
  template <typename Item>
  std::vector<Item> result(std::size_t index = 0) const {
    std::vector<Item> items(output_bytes(index) / sizeof(Item));
    read_output(index, items.data());
    return items;
  }

 private:
  struct State;
  std::unique_ptr<State> state_;
  void add_buffer(const void* data, std::size_t bytes, bool is_output);
  void add_value(const void* data, std::size_t bytes);
  std::size_t output_bytes(std::size_t index) const;
  void read_output(std::size_t index, void* data) const;
};

}  // namespace stokes::test
