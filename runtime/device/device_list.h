// Choosing among listed devices, and finding a listed device again for OpenCL. Internal to runtime/device, and for its tests.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "device/opencl.h"
#include "device/renderer.h"

namespace stokes {

/// The OpenCL object that `info` was made from. Throws DeviceError if it is gone.
cl::Device find_device(const DeviceInfo& info);

/// "P:D name" for messages.
std::string describe_device(const DeviceInfo& device);

}  // namespace stokes
