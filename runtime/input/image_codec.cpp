// Finds the module of image files and loads it once. Knows no image format and no OpenImageIO.
#include "input/image_codec.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace stokes {
namespace {
namespace fs = std::filesystem;

/// Where the module may stand: beside the program (or the Python extension) that this code is part of, where it is installed, where it was built.
std::vector<fs::path> folders() {
  std::vector<fs::path> all;
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&image_codec), &self) && self.dli_fname && fs::path(self.dli_fname).has_parent_path())
    all.push_back(fs::path(self.dli_fname).parent_path());
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  all.push_back(program);
  all.push_back(program / STOKES_MODULE_INSTALL_FOLDER);
  all.emplace_back(STOKES_MODULE_BUILD_FOLDER);
  return all;
}

const ImageCodec& load() {
  const std::string path = find_image_codec();
  // Local, so that the libraries behind it meet no others of their names, such as those of OpenCL drivers.
  void* module = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* function = module ? dlsym(module, kImageCodecSymbol) : nullptr;
  if (!function) throw std::runtime_error("images cannot be read or written: " + std::string(dlerror()));
  return *reinterpret_cast<ImageCodecFunction>(function)();
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

std::string find_image_codec() {
  std::error_code error;
  for (const fs::path& folder : folders())
    if (fs::is_regular_file(folder / kImageCodecModule, error)) return folder / kImageCodecModule;
  throw std::runtime_error(std::string("the part of the program that reads and writes images, ") + kImageCodecModule + ", is missing");
}

}  // namespace stokes
