// How a scene error becomes its one line. Knows positions and pointers, not what a scene may say.
#include "scene/error.h"

#include <algorithm>

#include "input/text.h"

namespace stokes {
namespace {

std::string format_line(const std::string& file, SourcePosition place, const std::string& pointer, const std::string& message) {
  return message_line(file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": error: " +
                      (pointer.empty() ? "" : pointer + ": ") + message);
}

bool is_below(const std::string& pointer, const std::string& ancestor) { return pointer.size() > ancestor.size() && pointer[ancestor.size()] == '/' && pointer.starts_with(ancestor); }

}  // namespace

SourcePosition SourceMap::find(const std::string& pointer) const {
  if (!places) return {1, 1};
  const std::string* nearest = &pointer;
  for (const std::string& known : replaced)
    if (is_below(*nearest, known)) nearest = &known;
  return places->value(*nearest);
}

std::optional<SourcePosition> SourceMap::find_key(const std::string& pointer) const {
  if (!places || std::any_of(replaced.begin(), replaced.end(), [&](const std::string& known) { return is_below(pointer, known); })) return std::nullopt;
  return places->key(pointer);
}

SceneError::SceneError(const SourceMap& source, const std::string& pointer, const std::string& message)
    : SceneError(source.file, source.find(pointer), pointer, message) {}

SceneError::SceneError(const std::string& file, SourcePosition place, const std::string& pointer, const std::string& message)
    : std::runtime_error(format_line(file, place, pointer, message)) {}

}  // namespace stokes
