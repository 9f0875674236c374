// A compiled scene's fingerprint.
#pragma once
#include <string>

#include "compiled/compiled_scene.h"

namespace stokes {

/// 16 hexadecimal digits over all that the picture depends on, meshes and overrides included; not over seed, samples, the film's
/// channels, nor the BVH, which depends on the device.
std::string scene_hash(const CompiledScene& scene);

}  // namespace stokes
