// The scene's arrays on the device, in the order of SceneView. Internal to runtime/device.
#pragma once
#include <cstdint>
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

/// Uploads every array; an empty one becomes 16 bytes of zeros, because OpenCL has no empty buffers. Throws cl::Error.
std::vector<cl::Buffer> upload_scene(const cl::Context& context, const CompiledScene& scene);

/// Throws DeviceError, flagged as out of memory and saying need and have, if a total or a single buffer is more than the device can hold.
void require_memory(const cl::Device& device, const std::string& device_name, std::uint64_t total_bytes, std::uint64_t largest_bytes);

}  // namespace stokes
