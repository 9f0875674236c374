// What every reader promises of its errors, checked for each input. Knows nothing of the readers.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>

namespace stokes::fuzz {

/// Ends the process with a message, which fuzzers take for a finding.
[[noreturn]] inline void finding(const char* what, const std::string& text) {
  std::fprintf(stderr, "FINDING: %s: %s\n", what, text.c_str());
  std::abort();
}

/// A scene error is one short line, `FILE:LINE:COLUMN: error: ...`, without control characters.
inline void check_scene_error(const std::string& line, const std::string& file) {
  if (!line.starts_with(file + ":")) finding("an error without its file", line);
  int row = 0, column = 0, used = 0;
  if (std::sscanf(line.c_str() + file.size(), ":%d:%d: error: %n", &row, &column, &used) != 2 || used == 0 || row < 1 || column < 1)
    finding("an error without its place", line);
  if (line.size() > 1100) finding("a very long error", line);
  for (const char c : line)
    if (static_cast<unsigned char>(c) < 0x20) finding("a control character in an error", line);
}

}  // namespace stokes::fuzz
