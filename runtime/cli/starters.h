// The scenes that `stokes new` writes and the schema beside them, as the program carries them. Made from scenes/ when it is built.
#pragma once
#include <map>
#include <string>

namespace stokes {

/// Texts by name: the starters "box", "skin", "fluorescent", and "schema".
const std::map<std::string, std::string>& starter_files();

}  // namespace stokes
