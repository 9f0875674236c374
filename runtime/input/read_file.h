// Whole files of strangers into memory. Knows sizes and kinds of files, not what they hold.
#pragma once
#include <cstdint>
#include <string>

namespace stokes {

/// The bytes of a regular file (no folder, pipe or device, which might never end) of at most `most` bytes. Throws std::runtime_error with the reason,
/// OutOfMemory where twice its size is not free.
std::string read_regular_file(const std::string& path, std::uint64_t most);

}  // namespace stokes
