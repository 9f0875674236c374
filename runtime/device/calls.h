// Turns failed OpenCL calls into DeviceErrors that name the call, the code and the device. Knows no call in particular.
#pragma once
#include <string>
#include <utility>

#include "device/error.h"
#include "device/opencl.h"

namespace stokes {

/// The name of an OpenCL status code ("CL_OUT_OF_RESOURCES"), or "OpenCL code -1234" for one that has none.
std::string error_name(cl_int code);

/// Throws the DeviceError for a failed call; codes that mean "no memory left" are flagged as such.
[[noreturn]] void throw_device_error(const cl::Error& error, const std::string& device);

/// Runs `body`, which may throw cl::Error, and lets a DeviceError out instead.
template <typename Body>
decltype(auto) checked(const std::string& device, Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const cl::Error& error) {
    throw_device_error(error, device);
  }
}

}  // namespace stokes
