// Which program this is.
#pragma once
#include <string>

namespace stokes {

/// "0.1.0 (1a2b3c4)": the version and the git hash at build, with a plus where files differed from it; part of every output.
std::string program_version();

}  // namespace stokes
