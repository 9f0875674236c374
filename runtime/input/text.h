// Text of strangers: whether it is UTF-8, and how it is shown without steering a terminal. Knows bytes, not where they come from.
#pragma once
#include <string>
#include <string_view>

namespace stokes {

/// The text with a blank for every byte of a control character: ASCII's, and in UTF-8 C1, the separators of lines and paragraphs, and those that
/// turn the direction of writing. They could break a promise of one line, steer a terminal, or show another text than there is.
std::string visible_line(std::string text);
/// As visible_line, but line feeds stay.
std::string visible_text(std::string text);

/// A message as one visible line of at most about a thousand bytes: longer ones are cut in the middle.
std::string message_line(const std::string& message);

/// Where the first bytes stand that are not UTF-8; npos where all are.
std::size_t find_invalid_utf8(std::string_view text);

}  // namespace stokes
