// Bytes under a file's name, for readers that take names. Knows nothing of who reads it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace stokes::fuzz {

/// A folder in memory that goes with the process; its one file is replaced by every call. Returns the file's path.
const std::string& scratch_file(const std::string& name, const void* data, std::size_t size);
/// The folder.
const std::string& scratch_folder();

}  // namespace stokes::fuzz
