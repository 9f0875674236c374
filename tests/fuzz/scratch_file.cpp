// See scratch_file.h.
#include "fuzz/scratch_file.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace stokes::fuzz {
namespace {

struct Folder {
  Folder() {
    std::error_code error;
    const std::filesystem::path root = std::filesystem::is_directory("/dev/shm", error) ? "/dev/shm" : std::filesystem::temp_directory_path();
    path = (root / ("stokes_fuzz_" + std::to_string(getpid()))).string();
    std::filesystem::create_directory(path);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::string path;
};

}  // namespace

const std::string& scratch_folder() {
  static const Folder folder;
  return folder.path;
}

const std::string& scratch_file(const std::string& name, const void* data, std::size_t size) {
  static std::string path;
  path = scratch_folder() + "/" + name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  file.close();
  if (!file) std::abort();
  return path;
}

}  // namespace stokes::fuzz
