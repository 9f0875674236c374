// The two integrators behind one call, for tests that render compiled scenes whole. Knows nothing of what is rendered.
#pragma once
#include <stdexcept>
#include <string>

#include "image/film.h"
#include "support/truth_scenes.h"

namespace stokes::tests {

/// A render had samples that are not finite.
class InvalidSamples : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A fixed seed of its own for every name (FNV-1a), so that the errors of many tests are independent. The environment
/// variable STOKES_SEED_SALT, if set, gives other seeds.
std::uint32_t seed_of(const std::string& name);

/// All samples [0, spp) of the whole image by the CPU reference.
Film render_by_reference(const CompiledScene& scene, int spp, std::uint32_t seed);
/// The same on the OpenCL device of the environment variable STOKES_DEVICE ("auto" without it), by the kernels in `kernel_dir` if it is not
/// empty. Throws InvalidSamples.
Film render_by_opencl(const CompiledScene& scene, int spp, std::uint32_t seed, const std::string& kernel_dir = "");

/// For truth cases.
Image reference_backend(const CompiledScene& scene, int spp, std::uint32_t seed);
Image opencl_backend(const CompiledScene& scene, int spp, std::uint32_t seed);

}  // namespace stokes::tests
