// The names of the limits, and their text.
#include "input/limits.h"

#include <charconv>

#include "input/memory.h"

namespace stokes {
namespace {

std::string known_names() {
  std::string names;
  for (const LimitName& limit : limit_names()) names += (names.empty() ? "" : ", ") + std::string(limit.name);
  return names;
}

}  // namespace

const std::vector<LimitName>& limit_names() {
  static const std::vector<LimitName> names = {
      {"scene-bytes", &InputLimits::scene_bytes, "size of the scene file"},
      {"mesh-bytes", &InputLimits::mesh_bytes, "size of an OBJ file"},
      {"image-bytes", &InputLimits::image_bytes, "size of an image file"},
      {"table-bytes", &InputLimits::table_bytes, "size of a file of spectra or a matrix"},
      {"depth", &InputLimits::depth, "nesting of the JSON, and of spectra and materials that refer to others"},
      {"values", &InputLimits::values, "values of the JSON"},
      {"keys", &InputLimits::keys, "keys of one JSON object"},
      {"surfaces", &InputLimits::surfaces, "surfaces"},
      {"materials", &InputLimits::materials, "named materials"},
      {"media", &InputLimits::media, "named media"},
      {"spectra", &InputLimits::spectra, "named spectra, and terms of one sum or product"},
      {"curve-samples", &InputLimits::curve_samples, "samples of one spectrum"},
      {"vertices", &InputLimits::vertices, "vertices of one mesh"},
      {"faces", &InputLimits::faces, "triangles of one mesh"},
      {"image-side", &InputLimits::image_side, "width or height of a texture"},
      {"image-pixels", &InputLimits::image_pixels, "pixels of a texture"},
      {"side", &InputLimits::side, "width or height of the film"},
      {"pixels", &InputLimits::pixels, "pixels of the film"},
      {"samples", &InputLimits::samples, "samples per pixel"},
      {"memory", &InputLimits::memory, "bytes; 0: what the machine has free"},
  };
  return names;
}

void set_limit(InputLimits& limits, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw std::invalid_argument("'" + text + "' is not NAME=VALUE; the names are " + known_names());
  const std::string name = text.substr(0, equals), number = text.substr(equals + 1);
  for (const LimitName& limit : limit_names()) {
    if (name != limit.name) continue;
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    const std::string unit(stop, number.data() + number.size());
    const int shift = unit.empty() ? 0 : unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : -1;
    if (error != std::errc() || shift < 0 || value > (UINT64_MAX >> shift))
      throw std::invalid_argument("'" + number + "' is no whole number (which K, M or G may follow)");
    limits.*limit.value = value << shift;
    return;
  }
  throw std::invalid_argument("there is no limit called '" + name + "'; the names are " + known_names());
}

std::uint64_t memory_limit(const InputLimits& limits) {
  if (limits.memory > 0) return limits.memory;
  const std::uint64_t free = available_memory();
  return free > 0 ? free : UINT64_MAX;
}

void require_memory(const InputLimits& limits, std::uint64_t bytes, const std::string& what) {
  const std::uint64_t have = memory_limit(limits);
  if (bytes <= have) return;
  throw OutOfMemory("out of memory: " + what + " needs " + gibibytes(bytes) + ", " +
                    (limits.memory > 0 ? gibibytes(have) + " are allowed (--limit memory)" : gibibytes(have) + " are free"));
}

}  // namespace stokes
