// The pages as the library carries them, each with its styles and scripts inside. Made from page/ when it is built.
#pragma once
#include <map>
#include <string>

namespace stokes {

/// HTML by file name: "viewer.html", which `stokes view` serves, and "report.html", which `--html` fills.
const std::map<std::string, std::string>& page_files();

}  // namespace stokes
