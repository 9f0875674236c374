// The exceptions of the device side.
#pragma once
#include <stdexcept>
#include <string>

namespace stokes {

/// An OpenCL call failed or no device is usable: the call, the code's name and the device are in what().
class DeviceError : public std::runtime_error {
 public:
  explicit DeviceError(const std::string& message, bool out_of_memory = false) : std::runtime_error(message), out_of_memory_(out_of_memory) {}
  bool out_of_memory() const { return out_of_memory_; }

 private:
  bool out_of_memory_;
};

/// The kernels did not build; what() is one line, log() the compiler's whole log with true file names and lines.
class KernelBuildError : public DeviceError {
 public:
  KernelBuildError(const std::string& message, std::string log) : DeviceError(message), log_(std::move(log)) {}
  const std::string& log() const { return log_; }

 private:
  std::string log_;
};

}  // namespace stokes
