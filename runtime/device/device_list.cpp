// Lists every OpenCL device and picks one by the user's words. Knows nothing of scenes or kernels.
#include "device/device_list.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "device/calls.h"
#include "device/driver_cache.h"

namespace stokes {

namespace {

std::vector<cl::Platform> list_platforms() {
  isolate_driver_cache();
  // The loader answers "not found" where no platform is installed; to us that is an empty list.
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    platforms.clear();
  }
  return platforms;
}

std::vector<cl::Device> list_platform_devices(const cl::Platform& platform) {
  std::vector<cl::Device> devices;
  try {
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
  } catch (const cl::Error&) {
    devices.clear();
  }
  return devices;
}

std::string trimmed(std::string text) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) || c == 0; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
  return text;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool contains(const std::string& text, const std::string& part) { return lower(text).find(lower(part)) != std::string::npos; }

// A simulator may claim to be every type at once; what it runs on is the CPU.
std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_CPU) return "cpu";
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  return "accelerator";
}

// What the kernels cannot do without; the empty string when nothing is missing.
std::string find_obstacle(const cl::Device& device) {
  if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "the driver says it is not available";
  if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "it has no OpenCL C compiler";
  if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "it is big-endian";
  if (contains(device.getInfo<CL_DEVICE_PROFILE>(), "EMBEDDED")) return "it has only the embedded profile";
  int major = 0, minor = 0;
  if (std::sscanf(device.getInfo<CL_DEVICE_VERSION>().c_str(), "OpenCL %d.%d", &major, &minor) != 2 || major * 10 + minor < 12)
    return "it is older than OpenCL 1.2";
  return "";
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int platform_index, int device_index) {
  DeviceInfo info;
  info.platform = platform_index;
  info.device = device_index;
  try {
    info.platform_name = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.why_not = find_obstacle(device);
  } catch (const cl::Error& error) {
    info.why_not = std::string(error.what()) + " failed with " + error_name(error.err());
  }
  info.usable = info.why_not.empty();
  return info;
}

std::string list_lines(const std::vector<DeviceInfo>& devices) {
  std::string lines;
  for (const DeviceInfo& device : devices)
    lines += "\n  " + describe_device(device) + (device.usable ? "" : " (not usable: " + device.why_not + ")");
  return lines;
}

const DeviceInfo& require_usable(const DeviceInfo& device) {
  if (!device.usable) throw DeviceError("device " + describe_device(device) + " is not usable: " + device.why_not);
  return device;
}

// "P:D", or nothing when the words have another form.
std::optional<std::pair<int, int>> parse_numbers(const std::string& spec) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c); };
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == spec.size() || spec.size() > 9) return {};
  if (!std::all_of(spec.begin(), spec.begin() + colon, is_digit)) return {};
  if (!std::all_of(spec.begin() + colon + 1, spec.end(), is_digit)) return {};
  return std::pair{std::stoi(spec.substr(0, colon)), std::stoi(spec.substr(colon + 1))};
}

// Among CPUs, PoCL's and Intel's runtimes come before the others: the latter simulate or interpret, hundreds of times slower.
bool is_fast_cpu_platform(const DeviceInfo& device) {
  return contains(device.platform_name, "portable computing language") || contains(device.platform_name, "intel");
}

const DeviceInfo* first_of_type(const std::vector<DeviceInfo>& devices, const std::string& type, std::uint64_t need_bytes) {
  const DeviceInfo* found = nullptr;
  for (const DeviceInfo& device : devices) {
    if (!device.usable || device.type != type || device.memory_bytes < need_bytes) continue;
    if (type != "cpu" || is_fast_cpu_platform(device)) return &device;
    if (!found) found = &device;
  }
  return found;
}

}  // namespace

std::string describe_device(const DeviceInfo& device) {
  return std::to_string(device.platform) + ":" + std::to_string(device.device) + " " + device.name + " (" + device.platform_name + ")";
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> result;
  const std::vector<cl::Platform> platforms = list_platforms();
  for (std::size_t p = 0; p < platforms.size(); ++p) {
    const std::vector<cl::Device> devices = list_platform_devices(platforms[p]);
    for (std::size_t d = 0; d < devices.size(); ++d)
      result.push_back(describe(platforms[p], devices[d], static_cast<int>(p), static_cast<int>(d)));
  }
  return result;
}

DeviceInfo choose_among(const std::vector<DeviceInfo>& devices, const std::string& spec, std::uint64_t need_bytes) {
  if (devices.empty()) throw DeviceError("no OpenCL device was found; install a runtime such as pocl-opencl-icd, or use --device reference");
  if (const auto numbers = parse_numbers(spec)) {
    for (const DeviceInfo& device : devices)
      if (device.platform == numbers->first && device.device == numbers->second) return require_usable(device);
    throw DeviceError("there is no device " + spec + "; there are:" + list_lines(devices));
  }
  const std::string word = lower(spec);
  if (word == "auto" || word.empty()) {
    for (const char* type : {"gpu", "accelerator", "cpu"})
      if (const DeviceInfo* found = first_of_type(devices, type, need_bytes)) return *found;
    throw DeviceError("no OpenCL device is usable:" + list_lines(devices));
  }
  if (word == "gpu" || word == "cpu" || word == "accelerator") {
    if (const DeviceInfo* found = first_of_type(devices, word, 0)) return *found;
    throw DeviceError("no " + word + " is usable; there are:" + list_lines(devices));
  }
  std::vector<DeviceInfo> matches;
  for (const DeviceInfo& device : devices)
    if (contains(device.name, spec) || contains(device.platform_name, spec)) matches.push_back(device);
  if (matches.empty()) throw DeviceError("no device is called '" + spec + "'; there are:" + list_lines(devices));
  if (matches.size() > 1) throw DeviceError("'" + spec + "' names several devices:" + list_lines(matches));
  return require_usable(matches.front());
}

DeviceInfo choose_device(const std::string& spec, std::uint64_t need_bytes) { return choose_among(list_devices(), spec, need_bytes); }

cl::Device find_device(const DeviceInfo& info) {
  const std::vector<cl::Platform> platforms = list_platforms();
  if (info.platform >= 0 && info.platform < static_cast<int>(platforms.size())) {
    const std::vector<cl::Device> devices = list_platform_devices(platforms[info.platform]);
    if (info.device >= 0 && info.device < static_cast<int>(devices.size())) return devices[info.device];
  }
  throw DeviceError("device " + describe_device(info) + " is no longer there");
}

void limit_cpu_threads(int threads) {
  if (threads <= 0) return;
  const std::string count = std::to_string(threads);
  for (const char* name : {"POCL_MAX_PTHREAD_COUNT", "CL_CONFIG_CPU_TBB_NUM_WORKERS"}) setenv(name, count.c_str(), 0);
}

int default_lanes(const DeviceInfo& device) {
  // Rusticl needs minutes to build wide lanes; elsewhere a CPU's width is in explicit vectors, a GPU's in its work-items.
  return device.type == "cpu" && !contains(device.platform_name, "rusticl") ? 8 : 1;
}

int default_bvh_width(const DeviceInfo& device) { return device.type == "cpu" ? 8 : 2; }

}  // namespace stokes
