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

/// What a scene says of itself is one short line, `FILE:LINE:COLUMN: KIND: ...`, without control characters.
inline void check_scene_line(const std::string& line, const std::string& file, const std::string& kind) {
  if (!line.starts_with(file + ":")) finding("an error without its file", line);
  int row = 0, column = 0, used = 0;
  if (std::sscanf(line.c_str() + file.size(), ":%d:%d: %n", &row, &column, &used) != 2 || used == 0 || row < 1 || column < 1)
    finding("an error without its place", line);
  if (line.compare(file.size() + static_cast<std::size_t>(used), kind.size() + 2, kind + ": ") != 0) finding("an error of another kind", line);
  if (line.size() > 1100) finding("a very long error", line);
  for (const char c : line)
    if (static_cast<unsigned char>(c) < 0x20) finding("a control character in an error", line);
}

inline void check_scene_error(const std::string& line, const std::string& file) { check_scene_line(line, file, "error"); }
inline void check_scene_warning(const std::string& line, const std::string& file) { check_scene_line(line, file, "warning"); }

}  // namespace stokes::fuzz
