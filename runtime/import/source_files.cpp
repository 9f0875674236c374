// Files that an imported scene names: read, or named from where the scene will stand. Knows nothing of what they hold.
#include <filesystem>

#include "import/imported_scene.h"
#include "scene/read_context.h"

namespace stokes {

std::string relative_file(const ImportTarget& target, const std::string& source_folder, const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path absolute = fs::absolute(fs::path(source_folder) / path).lexically_normal();
  const fs::path relative = absolute.lexically_relative(fs::absolute(target.folder.empty() ? "." : target.folder).lexically_normal());
  return (relative.empty() ? absolute : relative).generic_string();
}

void require_readable(const ImportTarget& target, const std::string& scene_folder, const std::string& path) {
  namespace fs = std::filesystem;
  if (path.find('\0') != std::string::npos) throw std::runtime_error("its name has a character 0");
  // Whether a file outside exists is already none of the scene's business.
  if (!target.allow_outside && !lies_where_allowed(path, scene_folder))
    throw std::runtime_error("it lies outside the scene's folder, its parent and the working folder (--allow-outside permits it)");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw std::runtime_error("there is no such file");
  if (!fs::is_regular_file(status)) throw std::runtime_error("it is no regular file");
}

std::string path_beside(const ImportTarget& target, const std::string& source_folder, const std::string& name) {
  const std::string path = (std::filesystem::path(source_folder) / name).string();
  require_readable(target, source_folder, path);
  return path;
}

}  // namespace stokes
