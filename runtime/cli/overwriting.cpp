// See overwriting.h.
#include "cli/overwriting.h"

#include <filesystem>

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

void require_page_name(const std::string& path) {
  if (!path.empty() && !path.ends_with(".html") && !path.ends_with(".htm")) throw UsageError("--html: '" + path + "' does not end in .html");
}

}  // namespace stokes
