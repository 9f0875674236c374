// Warnings and file names relative to the scene.
#include "scene/read_context.h"

#include <filesystem>
#include <fstream>

namespace stokes {

std::string format_warning(const SourceMap& source, const std::string& pointer, const std::string& message) {
  std::string line = SceneError(source, pointer, message).what();
  const std::string word = ": error: ";
  if (const auto at = line.find(word); at != std::string::npos) line.replace(at, word.size(), ": warning: ");
  return line;
}

double ReadContext::units_per_millimetre() const {
  switch (scene.scene_unit) {
    case LengthUnit::Metre: return 1e-3;
    case LengthUnit::Centimetre: return 0.1;
    case LengthUnit::Millimetre:
    case LengthUnit::None: break;
  }
  return 1;
}

void ReadContext::warn(const JsonNode& node, const std::string& message) {
  scene.warnings.push_back(format_warning(node.source(), node.pointer(), message));
}

std::string ReadContext::file_path(const JsonNode& name) const {
  const std::string text = name.string();
  if (text.empty()) name.fail("the file name is empty");
  const std::filesystem::path path = std::filesystem::path(scene.directory) / text;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) name.fail("there is no file " + path.string());
  if (std::filesystem::is_directory(status)) name.fail(path.string() + " is a folder");
  if (!std::ifstream(path)) name.fail(path.string() + " cannot be read");
  scene.files.push_back(path.string());
  return path.string();
}

}  // namespace stokes
