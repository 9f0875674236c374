// How much input is read before it is refused, and from where. Knows numbers and their names, nothing of what a scene is made of.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace stokes {

/// Bounds on what a scene and its files may ask for. The defaults are far above sensible scenes and far below what harms a machine.
struct InputLimits {
  std::uint64_t scene_bytes = std::uint64_t{64} << 20;    ///< of the scene file
  std::uint64_t mesh_bytes = std::uint64_t{4} << 30;      ///< of an OBJ file
  std::uint64_t image_bytes = std::uint64_t{2} << 30;     ///< of an image file
  std::uint64_t table_bytes = std::uint64_t{64} << 20;    ///< of a file of spectra or a matrix
  std::uint64_t depth = 100;                              ///< nesting of the JSON, and of what refers to each other by name
  std::uint64_t values = 4'000'000;                       ///< of the JSON, keys and containers included
  std::uint64_t keys = 1000;                              ///< of one JSON object
  std::uint64_t surfaces = 1'000'000;                     ///< leaves of the tree; also the entries of one group
  std::uint64_t materials = 10'000;                       ///< named ones, and those of one mesh
  std::uint64_t media = 10'000;
  std::uint64_t spectra = 10'000;                         ///< named ones, and the terms of one sum or product, expanded
  std::uint64_t curve_samples = 100'000;                  ///< of one sampled spectrum
  std::uint64_t vertices = 100'000'000;                   ///< of one mesh
  std::uint64_t faces = 100'000'000;                      ///< of one mesh
  std::uint64_t image_side = 32768;                       ///< of a texture, pixels
  std::uint64_t image_pixels = std::uint64_t{1} << 28;    ///< of a texture
  std::uint64_t side = 65536;                             ///< of the film, pixels
  std::uint64_t pixels = std::uint64_t{1} << 28;          ///< of the film
  std::uint64_t samples = std::uint64_t{1} << 30;         ///< per pixel
  std::uint64_t memory = 0;                               ///< bytes that reading and the scene may need; 0: what the machine has free
  bool allow_outside = false;                             ///< files may lie outside the scene's folder, its parent and the working folder
};

/// One limit as the command line knows it.
struct LimitName {
  const char* name;
  std::uint64_t InputLimits::*value;
  const char* what;
};

/// All limits, in the order of the struct.
const std::vector<LimitName>& limit_names();

/// Applies "NAME=VALUE" (K, M, G after the number: times 1024, 1024^2, 1024^3). Throws std::invalid_argument with the reason.
void set_limit(InputLimits& limits, const std::string& text);

/// Input went past a limit that is the machine's memory; what() says need and have.
class OutOfMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes that `limits` allow: the limit itself, or the machine's free memory.
std::uint64_t memory_limit(const InputLimits& limits);

/// Throws OutOfMemory ("the mesh needs 3.00 GiB of memory, and 1.00 GiB are free") when `bytes` go beyond the limit.
void require_memory(const InputLimits& limits, std::uint64_t bytes, const std::string& what);

}  // namespace stokes
