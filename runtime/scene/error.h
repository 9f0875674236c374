// The one exception for bad scenes and inputs, and the map from JSON pointers to places in the file.
#pragma once
#include <map>
#include <stdexcept>
#include <string>

namespace stokes {

struct SourcePosition {
  int line = 0, column = 0;
};

/// Where each JSON value of a scene file stands. Keys are JSON pointers.
struct SourceMap {
  std::string file;
  std::map<std::string, SourcePosition> places;
  /// The place of `pointer`, or of its nearest ancestor that has one.
  SourcePosition find(std::string pointer) const;
};

/// A scene or input file is wrong. what() is one line: `file:line:col: error: /json/pointer: message`.
class SceneError : public std::runtime_error {
 public:
  SceneError(const SourceMap& source, const std::string& pointer, const std::string& message);
  explicit SceneError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace stokes
