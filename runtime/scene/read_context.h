// What the readers of a scene's parts share: the description being filled, the names defined so far, the folder files are
// relative to. Knows which parts there are, not how any of them is spelt.
#pragma once
#include <string>
#include <utility>
#include <vector>

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
    for (const auto& entry : entries_)
      if (entry.first == name) name_node.fail("there is already a " + sort_ + " named \"" + name + "\"");
    entries_.emplace_back(name, std::move(value));
  }
  const Pointer* find(const std::string& name) const {
    for (const auto& entry : entries_)
      if (entry.first == name) return &entry.second;
    return nullptr;
  }
  /// The entry that a string names; fails with a suggestion when there is none.
  Pointer resolve(const JsonNode& node) const {
    const std::string name = node.string();
    if (const Pointer* found = find(name)) return *found;
    std::vector<std::string> names;
    for (const auto& entry : entries_) names.push_back(entry.first);
    node.fail("no " + sort_ + " named \"" + name + "\" is defined before this" + did_you_mean(name, names));
  }

 private:
  std::string sort_;
  std::vector<std::pair<std::string, Pointer>> entries_;
};

struct ReadContext {
  SceneDescription& scene;
  NameTable<SpectrumPtr> spectra{"spectrum"};
  NameTable<MediumPtr> media{"medium"};
  NameTable<MaterialPtr> materials{"material"};

  /// Scene units to the millimetre; 1 when the scene does not name its unit.
  double units_per_millimetre() const;
  void warn(const JsonNode& node, const std::string& message);
  /// A file of the scene: relative names start at the scene's folder. Fails when it is no readable file.
  std::string file_path(const JsonNode& name) const;
};

/// `file:line:col: warning: pointer: message`, for SceneDescription::warnings.
std::string format_warning(const SourceMap& source, const std::string& pointer, const std::string& message);

}  // namespace stokes
