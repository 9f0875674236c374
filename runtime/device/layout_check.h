// Asks a device where it puts the members of the shared structs. OpenCL promises no struct layout, so this is measured, not assumed.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "device/renderer.h"

namespace stokes {

struct LayoutField {
  std::string name;
  std::size_t offset, size;  ///< bytes, on the host
};

struct LayoutStruct {
  std::string name;
  std::size_t size;
  std::vector<LayoutField> fields;
};

/// The structs of layout.h as the host compiler lays them out.
const std::vector<LayoutStruct>& layout_structs();

/// Compares the host's layout with the device's, member by member; one line per difference, empty if all agree.
/// Throws DeviceError or KernelBuildError if the probe does not run.
std::vector<std::string> check_layout(const DeviceInfo& device);

/// The same against another text of layout.h.
std::vector<std::string> check_layout(const DeviceInfo& device, const std::string& layout_text);

}  // namespace stokes
