// From program text to a built OpenCL program, through the cache on disk. Knows options and caches, not what the text says.
// Internal to runtime/device.
#pragma once
#include <string>
#include <vector>

#include "device/opencl.h"
#include "device/renderer.h"

namespace stokes {

struct BuiltProgram {
  cl::Program program;
  std::string cache_key;     ///< names platform, driver, device, options and source
  bool from_cache = false;
  std::string warning;       ///< one line, empty if the build went well at once
};

/// Options for every program of ours: OpenCL C 1.2, correctly rounded division and square root where the device must be asked for them.
/// Never fast math: images would differ between devices, and it was measured to gain nothing.
std::string build_options(const cl::Device& device, bool optimise);

struct BuildChoices {
  bool optimise = true;
  bool use_cache = true;
};

/// Takes the program from the cache or builds it. A failed build is tried once more without optimisation before it is an error.
/// Throws KernelBuildError with the first attempt's log.
BuiltProgram build_program(const cl::Context& context, const cl::Device& device, const DeviceInfo& info, const std::string& source, BuildChoices choices);

/// Writes the program's binary to the cache. To be called after the first enqueue: PoCL compiles only then, and a binary fetched
/// earlier would save nothing.
void store_program(const BuiltProgram& built);

/// Whether the device's compiler takes __builtin_ia32_movmskps256 and its code gives the right answer. Tried once per process,
/// and remembered in the cache.
bool probe_x86(const cl::Device& device, const DeviceInfo& info);

}  // namespace stokes
