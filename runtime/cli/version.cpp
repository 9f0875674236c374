// Which program this is. git_hash.h is written anew at every build, when it changed (see git_hash.cmake).
#include "cli/version.h"

#include "git_hash.h"

namespace stokes {

std::string program_version() { return std::string(STOKES_VERSION) + " (" + STOKES_GIT_HASH + ")"; }

}  // namespace stokes
