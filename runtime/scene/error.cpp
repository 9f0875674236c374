// How a scene error becomes its one line. Knows positions and pointers, not what a scene may say.
#include "scene/error.h"

namespace stokes {
namespace {

// Control characters could break the one-line promise (a key may contain any of them).
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string format_line(const SourceMap& source, const std::string& pointer, const std::string& message) {
  const SourcePosition place = source.find(pointer);
  return one_line(source.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                  ": error: " + (pointer.empty() ? "" : pointer + ": ") + message);
}

}  // namespace

SourcePosition SourceMap::find(std::string pointer) const {
  while (true) {
    if (const auto it = places.find(pointer); it != places.end()) return it->second;
    if (pointer.empty()) return {1, 1};
    const std::size_t slash = pointer.rfind('/');
    pointer.resize(slash == std::string::npos ? 0 : slash);
  }
}

SceneError::SceneError(const SourceMap& source, const std::string& pointer, const std::string& message)
    : std::runtime_error(format_line(source, pointer, message)) {}

}  // namespace stokes
