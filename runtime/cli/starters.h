// The scenes that `stokes new` writes and the schema beside them, as the program carries them. Made from scenes/ when it is built.
#pragma once
#include <map>
#include <string>

namespace stokes {

/// Texts by file name: the starters "box.json", "skin.json", "fluorescent.json", and "schema.json".
const std::map<std::string, std::string>& starter_files();

}  // namespace stokes
