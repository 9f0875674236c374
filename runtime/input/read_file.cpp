// See read_file.h.
#include "input/read_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/limits.h"

namespace stokes {

std::string read_regular_file(const std::string& path, std::uint64_t most) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::runtime_error("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("it is no regular file");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error("it cannot be opened");
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
  if (size > most) throw std::runtime_error("it has " + std::to_string(size) + " bytes, and the limit is " + std::to_string(most));
  require_memory({}, 2 * size, path);
  std::string bytes(size, '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) throw std::runtime_error("it cannot be read");
  return bytes;
}

}  // namespace stokes
