// What a build of the kernels leaves in and out, as #define lines. Knows no OpenCL.
#pragma once
#include <string>

#include "compiled/compiled_scene.h"

namespace stokes {

/// The widths and capabilities that a device, not the scene, decides.
struct DeviceConstants {
  int lanes = 8;     ///< paths in lockstep per work-item: 1, 8 or 16
  bool x86 = false;  ///< the compiler takes x86 vector builtins
};

/// One `#define NAME value` line per build constant: LANES, BVH_WIDTH, WAVELENGTHS, INTEGRATOR, FILM_*, SCENE_*, STOKES_X86.
std::string build_constants(const CompiledScene& scene, const DeviceConstants& device);

}  // namespace stokes
