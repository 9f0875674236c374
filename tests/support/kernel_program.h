// Runs probe kernels on the first CPU device: builds a .cl file with the kernels folder on its include path, copies vectors in and out.
// Knows OpenCL and CompiledScene's arrays, nothing of the renderer's own device layer, so that a mistake there cannot hide here.
#pragma once
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "compiled/compiled_scene.h"

namespace stokes::testing {

/// The build constants of one variant of the kernels; every SCENE_HAS_... is on unless listed in `without`.
struct KernelVariant {
  int lanes = 8;
  int bvh_width = 8;
  int wavelengths = 4;
  bool rgb = false;
  bool x86 = true;
  std::vector<std::string> without;
  std::string extra;  ///< further -D options
};

/// A vector that a kernel writes: it keeps its size.
template <typename T>
struct Out {
  std::vector<T>& values;
};
template <typename T>
Out(std::vector<T>&) -> Out<T>;

/// One argument of a kernel, without its type.
struct Argument {
  enum class Kind { Input, Output, Value } kind;
  void* data;
  std::size_t bytes;
};

class KernelProgram {
 public:
  /// Builds `path` (relative to the repository). Throws std::runtime_error with the build log.
  KernelProgram(const std::string& path, const KernelVariant& variant);
  ~KernelProgram();
  KernelProgram(KernelProgram&&) noexcept;

  int lanes() const { return variant_.lanes; }

  /// Uploads the scene for run_with_scene.
  void set_scene(const CompiledScene& scene);

  /// Runs `work_items` of a kernel. Arguments: std::vector<T> (read), Out<T> (written), and plain numbers.
  template <typename... Args>
  void run(const std::string& kernel, std::size_t work_items, const Args&... args) {
    launch(kernel, work_items, false, {argument(args)...});
  }
  /// The same for kernels whose first arguments are the scene's buffers in view.cl's order.
  template <typename... Args>
  void run_with_scene(const std::string& kernel, std::size_t work_items, const Args&... args) {
    launch(kernel, work_items, true, {argument(args)...});
  }
  /// CPU seconds that the last launch took, copies not counted.
  double seconds() const { return seconds_; }

 private:
  template <typename T>
  static Argument argument(const std::vector<T>& v) {
    return {Argument::Kind::Input, const_cast<T*>(v.data()), v.size() * sizeof(T)};
  }
  template <typename T>
  static Argument argument(const Out<T>& v) {
    return {Argument::Kind::Output, v.values.data(), v.values.size() * sizeof(T)};
  }
  template <typename T>
    requires std::is_arithmetic_v<T>
  static Argument argument(const T& v) {
    return {Argument::Kind::Value, const_cast<T*>(&v), sizeof(T)};
  }
  void launch(const std::string& name, std::size_t work_items, bool with_scene, const std::vector<Argument>& arguments);

  struct Device;
  KernelVariant variant_;
  std::unique_ptr<Device> device_;
  double seconds_ = 0;
};

}  // namespace stokes::testing
