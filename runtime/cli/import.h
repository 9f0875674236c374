// `stokes import`, as a subcommand.
#pragma once
#include "cli/commands.h"

namespace stokes {

Command add_import(CLI::App& root);

}  // namespace stokes
