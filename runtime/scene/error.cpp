// How a scene error becomes its one line. Knows positions and pointers, not what a scene may say.
#include "scene/error.h"

#include <algorithm>

namespace stokes {
namespace {

constexpr std::size_t kLongest = 1000;  // bytes of a message; what it quotes may be a whole file

// Bytes of the control character at `i` (a key may contain any): ASCII's, and in UTF-8 C1, the separators of lines and paragraphs, and those
// that turn the direction of writing. They could break the one-line promise, steer a terminal, or show another text than there is.
std::size_t control_bytes(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u; };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return 1;
  if (byte(0) == 0xc2 && byte(1) >= 0x80 && byte(1) < 0xa0) return 2;
  const bool separator = byte(1) == 0x80 && byte(2) >= 0xa8 && byte(2) <= 0xae, direction = byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9;
  return byte(0) == 0xe2 && (separator || direction) ? 3 : 0;
}

std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t count = control_bytes(text, i);
    for (std::size_t k = 0; k < count; k++) text[i + k] = ' ';
    i += std::max<std::size_t>(count, 1);
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

std::string format_line(const std::string& file, SourcePosition place, const std::string& pointer, const std::string& message) {
  return shortened(one_line(file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                  ": error: " + (pointer.empty() ? "" : pointer + ": ") + message));
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
