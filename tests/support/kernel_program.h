// Runs probe kernels on the first CPU device: builds a .cl file with the kernels folder on its include path, copies vectors in and out.
// Knows OpenCL and CompiledScene's arrays, nothing of the renderer's own device layer, so that a mistake there cannot hide here.
#pragma once
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
#include <string>
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

class KernelProgram {
 public:
  /// Builds `path` (relative to the repository). Throws std::runtime_error with the build log.
  KernelProgram(const std::string& path, const KernelVariant& variant);

  int lanes() const { return variant_.lanes; }
  const KernelVariant& variant() const { return variant_; }

  /// Uploads the scene; kernels that are run `with_scene` get its buffers as their first arguments, in view.cl's order.
  void set_scene(const CompiledScene& scene);

  /// Runs `work_items` of a kernel. Arguments: const std::vector<T>& (read), Out<T> (written), and plain numbers.
  template <typename... Args>
  void run(const std::string& kernel, std::size_t work_items, Args&&... args) {
    launch(kernel, work_items, {}, std::forward<Args>(args)...);
  }
  template <typename... Args>
  void run_with_scene(const std::string& kernel, std::size_t work_items, Args&&... args) {
    launch(kernel, work_items, scene_, std::forward<Args>(args)...);
  }
  /// CPU seconds of the last launch.
  double seconds() const { return seconds_; }

 private:
  template <typename... Args>
  void launch(const std::string& name, std::size_t work_items, const std::vector<cl::Buffer>& first, Args&&... args) {
    cl::Kernel kernel(program_, name.c_str());
    outputs_.clear();
    cl_uint index = 0;
    for (const cl::Buffer& buffer : first) kernel.setArg(index++, buffer);
    std::vector<cl::Buffer> alive;
    (set(kernel, index++, alive, args), ...);
    enqueue(kernel, work_items);
    for (const Output& out : outputs_) queue_.enqueueReadBuffer(out.buffer, CL_TRUE, 0, out.bytes, out.host);
  }
  template <typename T>
  void set(cl::Kernel& kernel, cl_uint index, std::vector<cl::Buffer>& alive, const std::vector<T>& values) {
    alive.push_back(upload(values.data(), values.size() * sizeof(T)));
    kernel.setArg(index, alive.back());
  }
  template <typename T>
  void set(cl::Kernel& kernel, cl_uint index, std::vector<cl::Buffer>& alive, const Out<T>& out) {
    set(kernel, index, alive, out.values);
    outputs_.push_back({alive.back(), out.values.data(), out.values.size() * sizeof(T)});
  }
  template <typename T>
    requires std::is_arithmetic_v<T>
  void set(cl::Kernel& kernel, cl_uint index, std::vector<cl::Buffer>&, const T& value) {
    kernel.setArg(index, value);
  }
  cl::Buffer upload(const void* data, std::size_t bytes);
  void enqueue(cl::Kernel& kernel, std::size_t work_items);

  struct Output {
    cl::Buffer buffer;
    void* host;
    std::size_t bytes;
  };
  KernelVariant variant_;
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  std::vector<cl::Buffer> scene_;
  std::vector<Output> outputs_;
  double seconds_ = 0;
};

}  // namespace stokes::testing
