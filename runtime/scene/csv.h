// Fields of CSV lines. Knows nothing of what they mean.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stokes {

/// The trimmed fields of a line separated by commas, else semicolons, else blanks. After `most` fields the rest is not looked at.
std::vector<std::string> split_csv(const std::string& line, std::size_t most);
/// The number that the whole of `text` is; infinities and NaN are returned as such.
std::optional<double> parse_number(const std::string& text);

}  // namespace stokes
