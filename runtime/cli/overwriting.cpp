// See overwriting.h.
#include "cli/overwriting.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "cli/commands.h"
#include "cli/outputs.h"

namespace stokes {

void require_no_input(const OutputOptions& options, const std::vector<std::string>& inputs, const std::string& reader) {
  std::vector<std::string> outputs = {options.path};
  if (options.png) outputs.push_back(png_beside(options.path));
  std::error_code error;
  for (const std::string& output : outputs)
    for (const std::string& input : inputs)
      if (std::filesystem::equivalent(output, input, error)) throw UsageError("-o: " + output + " would be overwritten, and " + reader + " reads it");
}

void require_no_other_file(const std::string& path) {
  constexpr std::string_view kPage = "<!doctype html";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  std::ifstream file(path, std::ios::binary);
  std::string begin(kPage.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  std::transform(begin.begin(), begin.end(), begin.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!begin.empty() && begin != kPage) throw UsageError("--html: " + path + " exists and is no HTML page; it is not overwritten");
}

}  // namespace stokes
