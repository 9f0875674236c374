// The one exception for bad scenes and inputs, and the places in the file that it tells.
#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/json_places.h"

namespace stokes {

/// A scene file and where its values stand. Copies share the places.
struct SourceMap {
  std::string file;
  std::shared_ptr<const JsonPlaces> places = nullptr;  ///< null: every place is the file's begin
  std::vector<std::string> replaced = {};              ///< pointers of values that are not the file's: what is below them has their place
  /// The place of the value at `pointer`, or of its nearest ancestor that has one.
  SourcePosition find(const std::string& pointer) const;
  /// The place of the key whose value is at `pointer`, if the file has it.
  std::optional<SourcePosition> find_key(const std::string& pointer) const;
};

/// A scene or input file is wrong. what() is one line: `file:line:col: error: /json/pointer: message`.
class SceneError : public std::runtime_error {
 public:
  SceneError(const SourceMap& source, const std::string& pointer, const std::string& message);
  SceneError(const std::string& file, SourcePosition place, const std::string& pointer, const std::string& message);
  explicit SceneError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace stokes
