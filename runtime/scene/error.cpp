// How a scene error becomes its one line. Knows positions and pointers, not what a scene may say.
#include "scene/error.h"

namespace stokes {
namespace {

constexpr std::size_t kLongest = 1000;  // bytes of a message; what it quotes may be a whole file

// Control characters could break the one-line promise or steer a terminal (a key may contain any of them, also as UTF-8's C1).
std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size(); i++) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool c1 = c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (c < 0x20 || c == 0x7f || c1) text[i] = ' ';
    if (c1) text[i + 1] = ' ';
  }
  return text;
}

// Cut in the middle, between characters: the place stands at the begin, the reason mostly at the end.
std::string shortened(const std::string& text) {
  if (text.size() <= kLongest) return text;
  const auto inside = [&](std::size_t i) { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  std::size_t head = kLongest * 3 / 5, tail = text.size() - kLongest * 2 / 5;
  while (head > 0 && inside(head)) head--;
  while (inside(tail)) tail++;
  return text.substr(0, head) + " ... " + text.substr(tail);
}

std::string format_line(const SourceMap& source, const std::string& pointer, const std::string& message) {
  const SourcePosition place = source.find(pointer);
  return shortened(one_line(source.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                  ": error: " + (pointer.empty() ? "" : pointer + ": ") + message));
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
