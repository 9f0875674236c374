// The scene's arrays on the device, in the order of SceneView. Internal to runtime/device.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "compiled/compiled_scene.h"
#include "device/opencl.h"

namespace stokes {

/// One array of a scene: what a kernel argument is made from.
struct SceneArray {
  const char* name;  ///< SceneView's member
  const void* data;
  std::size_t bytes;  ///< may be 0
};

/// The arrays in the order of SceneView in kernels/view.cl, which is the order of the render kernel's first arguments.
std::vector<SceneArray> list_scene_arrays(const CompiledScene& scene);

/// A scene's arrays as buffers, and the host memory that they lie in where the device is the host. The memory outlives the buffers.
struct SceneBuffers {
  std::shared_ptr<void> memory;
  std::vector<cl::Buffer> buffers;
};

/// Makes a buffer of every array; an empty one becomes zeros, because OpenCL has no empty buffers. With `in_place` the device reads host
/// memory in large pages, which walks through big trees need; else it gets copies. Throws cl::Error, std::bad_alloc.
SceneBuffers upload_scene(const cl::Context& context, const CompiledScene& scene, bool in_place);

/// Throws DeviceError, flagged as out of memory and saying need and have, if a total or a single buffer is more than the device can hold.
void require_memory(const cl::Device& device, const std::string& device_name, std::uint64_t total_bytes, std::uint64_t largest_bytes);

}  // namespace stokes
