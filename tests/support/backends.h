// The two integrators behind one call, for tests that render compiled scenes whole. Knows nothing of what is rendered.
#pragma once
#include <string>

#include "image/film.h"
#include "support/truth_scenes.h"

namespace stokes::tests {

/// A fixed seed of its own for every name (FNV-1a), so that the errors of many tests are independent.
std::uint32_t seed_of(const std::string& name);

/// All samples [0, spp) of the whole image by the CPU reference.
Film render_by_reference(const CompiledScene& scene, int spp, std::uint32_t seed);
/// The same on the OpenCL device of the environment variable STOKES_DEVICE ("auto" without it), by the kernels in `kernel_dir` if it is not
/// empty. Throws std::runtime_error when a sample is invalid.
Film render_by_opencl(const CompiledScene& scene, int spp, std::uint32_t seed, const std::string& kernel_dir = "");

/// For truth cases.
Image reference_backend(const CompiledScene& scene, int spp, std::uint32_t seed);
Image opencl_backend(const CompiledScene& scene, int spp, std::uint32_t seed);

}  // namespace stokes::tests
