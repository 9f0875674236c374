// Warnings, limits, and file names relative to the scene.
#include "scene/read_context.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scene/memory_error.h"

namespace stokes {
namespace {

// Links and dots are resolved as far as the path exists; empty when that fails.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  if (error) return {};
  const std::filesystem::path real = std::filesystem::weakly_canonical(absolute, error);
  if (error) return {};
  return real.has_filename() ? real : real.parent_path();  // without a slash at its end; the root is its own parent
}

bool lies_within(const std::filesystem::path& real, const std::filesystem::path& root) {
  return !root.empty() && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

std::uint64_t InputLimits::*size_limit(FileSort sort) {
  switch (sort) {
    case FileSort::Mesh: return &InputLimits::mesh_bytes;
    case FileSort::Image: return &InputLimits::image_bytes;
    case FileSort::Table: break;
  }
  return &InputLimits::table_bytes;
}

}  // namespace

bool lies_where_allowed(const std::filesystem::path& path, const std::string& directory) {
  const std::filesystem::path real = resolved(path), scene_folder = resolved(directory.empty() ? "." : directory);
  if (real.empty() || scene_folder.empty()) return false;
  if (lies_within(real, scene_folder)) return true;
  // The scene's folder's parent, so that ../textures beside scenes/ is found.
  for (const std::filesystem::path& root : {scene_folder.parent_path(), resolved(".")})
    if (root != root.root_path() && lies_within(real, root)) return true;
  return false;
}

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

std::string ReadContext::file_path(const JsonNode& name, FileSort sort) const {
  namespace fs = std::filesystem;
  const std::string text = name.string();
  if (text.empty()) name.fail("the file name is empty");
  if (text.find('\0') != std::string::npos) name.fail("the file name has a character 0");
  const fs::path path = fs::path(scene.directory) / text;
  // Whether a file outside exists is already none of the scene's business.
  if (!limits.allow_outside && !lies_where_allowed(path, scene.directory))
    name.fail(path.string() + " lies outside the scene's folder, its parent and the working folder (--allow-outside permits it)");
  std::error_code error;
  const auto status = fs::status(path, error);
  if (error && error != std::errc::no_such_file_or_directory) name.fail(path.string() + " cannot be read: " + error.message());
  if (!fs::exists(status)) name.fail("there is no file " + path.string());
  if (fs::is_directory(status)) name.fail(path.string() + " is a folder");
  if (!fs::is_regular_file(status)) name.fail(path.string() + " is no regular file");
  if (!std::ifstream(path)) name.fail(path.string() + " cannot be read");
  const std::uint64_t size = fs::file_size(path, error);
  if (error) name.fail(path.string() + " cannot be read: " + error.message());
  require_within(name, size, size_limit(sort));
  scene.files.push_back(path.string());
  return path.string();
}

void ReadContext::require_within(const JsonNode& node, std::uint64_t count, std::uint64_t InputLimits::*limit) const {
  if (count <= limits.*limit) return;
  for (const LimitName& known : limit_names())
    if (known.value == limit)
      node.fail(std::string(known.what) + ": " + std::to_string(count) + " is more than the limit " + std::to_string(limits.*limit) + " (--limit " + known.name + ")");
}

void ReadContext::require_memory(const JsonNode& node, std::uint64_t bytes, const std::string& what) const {
  try {
    stokes::require_memory(limits, bytes, what);
  } catch (const OutOfMemory& error) {
    throw SceneMemoryError(node.source(), node.pointer(), error.what());
  }
}

void ReadContext::add_part(const JsonNode& node, const void* whole, const void* part, std::uint64_t InputLimits::*limit) {
  const auto known = extents.find(part);
  const Extent inner = known == extents.end() ? Extent{} : known->second;
  Extent& extent = extents[whole];
  extent.terms += inner.terms;  // each is within the limit already, so that nothing overflows
  extent.depth = std::max(extent.depth, inner.depth + 1);
  require_within(node, extent.terms, limit);
  require_within(node, extent.depth, &InputLimits::depth);
}

}  // namespace stokes
