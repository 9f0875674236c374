// Outputs that would replace what a user cannot mean to lose. Knows names of files, not what is in them.
#pragma once
#include <string>
#include <vector>

namespace stokes {

struct OutputOptions;

/// Throws UsageError where an output is one of the files that are read, under whatever name. `reader` says who reads them.
void require_no_input(const OutputOptions& options, const std::vector<std::string>& inputs, const std::string& reader);

/// Throws UsageError where the name of --html does not end so: it might be a picture or a scene.
void require_page_name(const std::string& path);

}  // namespace stokes
