// Turns failed OpenCL calls into DeviceErrors that name the call, the code and the device. Knows no call in particular.
#pragma once
#include <cstdint>
#include <string>
#include <utility>

#include "device/error.h"
#include "device/opencl.h"

namespace stokes {

/// The name of an OpenCL status code ("CL_OUT_OF_RESOURCES"), or "OpenCL code -1234" for one that has none.
std::string error_name(cl_int code);

/// Whether a status code means that memory ran out.
bool is_out_of_memory(cl_int code);

/// Throws the DeviceError for a failed call; one that means "no memory left" is flagged as such, and says what was needed and what the device
/// has where these are known (not 0).
[[noreturn]] void throw_device_error(const cl::Error& error, const std::string& device, std::uint64_t need_bytes = 0, std::uint64_t have_bytes = 0);

/// Runs `body`, which may throw cl::Error, and lets a DeviceError out instead.
template <typename Body>
decltype(auto) checked(const std::string& device, Body&& body, std::uint64_t need_bytes = 0, std::uint64_t have_bytes = 0) {
  try {
    return std::forward<Body>(body)();
  } catch (const cl::Error& error) {
    throw_device_error(error, device, need_bytes, have_bytes);
  }
}

}  // namespace stokes
