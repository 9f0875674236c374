// The Python program that drives Dask, as the executable carries it. Made from drive.py when it is built.
#pragma once
#include <map>
#include <string>

namespace stokes {

/// Texts by file name: "drive.py".
const std::map<std::string, std::string>& driver_files();

}  // namespace stokes
