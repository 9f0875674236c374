// What compiling a scene will take, told before it is spent. Knows sizes, not how anything is compiled.
#pragma once
#include <cstdint>
#include <string>

#include "scene/description.h"

namespace stokes {

/// Bytes, rounded upwards rather than down.
struct MemoryEstimate {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;  ///< with the BVH, while it is built
  std::uint64_t texels = 0;
  std::uint64_t other = 0;      ///< tables of spectra, surfaces
  std::uint64_t total() const { return vertices + triangles + texels + other; }
  /// "vertices 0.10 GiB, triangles and BVH 1.20 GiB, texels 0.00 GiB, other 0.01 GiB"
  std::string text() const;
};

MemoryEstimate estimate_memory(const SceneDescription& scene);

}  // namespace stokes
