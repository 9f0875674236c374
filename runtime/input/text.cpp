// See text.h.
#include "input/text.h"

#include <algorithm>

namespace stokes {
namespace {

constexpr std::size_t kLongest = 1000;  // bytes of a message; what it quotes may be a whole file

unsigned byte_at(std::string_view text, std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; }

/// Bytes of the control character at `i`; 0 where there is none.
std::size_t control_bytes(std::string_view text, std::size_t i) {
  const unsigned first = byte_at(text, i), second = byte_at(text, i + 1), third = byte_at(text, i + 2);
  if (first < 0x20 || first == 0x7f) return 1;
  if (first == 0xc2 && second >= 0x80 && second < 0xa0) return 2;
  const bool separator = second == 0x80 && third >= 0xa8 && third <= 0xae, direction = second == 0x81 && third >= 0xa6 && third <= 0xa9;
  return first == 0xe2 && (separator || direction) ? 3 : 0;
}

/// Bytes of the UTF-8 sequence at `i`; 0 where there is none. Neither longer than needed, nor a surrogate, nor beyond U+10FFFF.
std::size_t sequence_bytes(std::string_view text, std::size_t i) {
  const unsigned first = byte_at(text, i), second = byte_at(text, i + 1);
  const auto follows = [&](std::size_t count) {
    for (std::size_t k = 1; k <= count; k++)
      if ((byte_at(text, i + k) & 0xc0) != 0x80) return false;
    return true;
  };
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return follows(1) ? 2 : 0;
  if (first >= 0xe0 && first < 0xf0) return follows(2) && !(first == 0xe0 && second < 0xa0) && !(first == 0xed && second >= 0xa0) ? 3 : 0;
  if (first >= 0xf0 && first < 0xf5) return follows(3) && !(first == 0xf0 && second < 0x90) && !(first == 0xf4 && second >= 0x90) ? 4 : 0;
  return 0;
}

}  // namespace

std::string visible_line(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t count = control_bytes(text, i);
    for (std::size_t k = 0; k < count; k++) text[i + k] = ' ';
    i += std::max<std::size_t>(count, 1);
  }
  return text;
}

std::string visible_text(std::string text) {
  const std::string given = text;
  text = visible_line(std::move(text));
  for (std::size_t i = 0; i < text.size(); i++)
    if (given[i] == '\n') text[i] = '\n';
  return text;
}

std::string message_line(const std::string& message) {
  const std::string text = visible_line(message);
  if (text.size() <= kLongest) return text;
  // Between characters: the place stands at the begin, the reason mostly at the end.
  const auto inside = [&](std::size_t i) { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  std::size_t head = kLongest * 3 / 5, tail = text.size() - kLongest * 2 / 5;
  while (head > 0 && inside(head)) head--;
  while (inside(tail)) tail++;
  return text.substr(0, head) + " ... " + text.substr(tail);
}

std::size_t find_invalid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t count = sequence_bytes(text, i);
    if (count == 0) return i;
    i += count;
  }
  return std::string_view::npos;
}

}  // namespace stokes
