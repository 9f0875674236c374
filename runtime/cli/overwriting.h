// Outputs that would replace what a user cannot mean to lose. Knows names of files, not what is in them.
#pragma once
#include <string>
#include <vector>

namespace stokes {

struct OutputOptions;

/// Throws UsageError where an output is one of the files that are read, under whatever name. `reader` says who reads them.
void require_no_input(const OutputOptions& options, const std::vector<std::string>& inputs, const std::string& reader);

/// Throws UsageError where --html names a file that is no page, such as a picture or a scene.
void require_no_other_file(const std::string& path);

}  // namespace stokes
