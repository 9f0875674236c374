// What the readers of a scene's parts share: the description being filled, the names defined so far, the folder files are
// relative to. Knows which parts there are, not how any of them is spelt.
#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/limits.h"
#include "scene/description.h"
#include "scene/json_node.h"

namespace stokes {

/// The things of one sort that the scene has named so far.
template <class Pointer>
class NameTable {
 public:
  /// `sort` is what messages call an entry ("material").
  explicit NameTable(std::string sort) : sort_(std::move(sort)) {}

  void add(const JsonNode& name_node, const std::string& name, Pointer value) {
    if (!entries_.emplace(name, std::move(value)).second) name_node.fail("there is already a " + sort_ + " named \"" + name + "\"");
  }
  const Pointer* find(const std::string& name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
  }
  /// The entry that a string names; fails with a suggestion when there is none.
  Pointer resolve(const JsonNode& node) const {
    const std::string name = node.string();
    if (const Pointer* found = find(name)) return *found;
    std::vector<std::string> names;
    for (const auto& entry : entries_) names.push_back(entry.first);
    std::sort(names.begin(), names.end());  // so that of two that are as near the same is always suggested
    node.fail("no " + sort_ + " named \"" + name + "\" is defined before this" + did_you_mean(name, names));
  }

 private:
  std::string sort_;
  std::unordered_map<std::string, Pointer> entries_;
};

/// How large a thing made of others is. Names make it a graph without cycles; walking it takes as long as the tree is large that it
/// unfolds to, which doubles with every name that is used twice.
struct Extent {
  std::uint64_t terms = 1, depth = 1;
};

/// Whether a file lies in or below the folder `directory`, the one that this lies in, or the working folder, once links are followed. The
/// file system's root as one of the latter two does not count: it would let in everything.
bool lies_where_allowed(const std::filesystem::path& path, const std::string& directory);

/// What may belong to a scene's folder, by the limit on its size.
enum class FileSort { Mesh, Image, Table };

struct ReadContext {
  SceneDescription& scene;
  const InputLimits& limits;
  NameTable<SpectrumPtr> spectra{"spectrum"};
  NameTable<MediumPtr> media{"medium"};
  NameTable<MaterialPtr> materials{"material"};
  std::map<const void*, Extent> extents{};  ///< of sums, products and blends; what is not here is one term
  std::map<std::string, std::shared_ptr<const MeshData>> generated{};  ///< procedural meshes in scene units, by their parameters

  /// Scene units to the millimetre; 1 when the scene does not name its unit.
  double units_per_millimetre() const;
  void warn(const JsonNode& node, const std::string& message);
  /// A file of the scene: relative names start at the scene's folder. Fails when it is no readable regular file, lies outside that
  /// folder, its parent and the working folder (links are followed first) though the limits do not allow it, or is larger than they do.
  std::string file_path(const JsonNode& name, FileSort sort) const;
  /// Fails with "N surfaces, and the limit is M (--limit surfaces)" when `count` goes beyond the limit of that name.
  void require_within(const JsonNode& node, std::uint64_t count, std::uint64_t InputLimits::*limit) const;
  /// Fails when there is not enough memory for `what`.
  void require_memory(const JsonNode& node, std::uint64_t bytes, const std::string& what) const;
  /// Counts `part` as one of the things that make up `whole`; fails at `node` when the whole unfolds too far.
  void add_part(const JsonNode& node, const void* whole, const void* part, std::uint64_t InputLimits::*limit);
};

/// `file:line:col: warning: pointer: message`, for SceneDescription::warnings.
std::string format_warning(const SourceMap& source, const std::string& pointer, const std::string& message);

}  // namespace stokes
