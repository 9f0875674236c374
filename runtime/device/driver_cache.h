// An empty cache folder for the driver, so that what it keeps between runs is never trusted. Knows folders and locks; no OpenCL.
#pragma once
#include <string>

namespace stokes {

/// Where the driver may put its files.
enum class DriverCachePlace {
  Usual,     ///< in the folder of POCL_CACHE_DIR, else in cache_folder(), else with temporary files
  Temporary  ///< with temporary files: for when the usual disk may be full or failing
};

/// Gives PoCL, which loads code from its cache unchecked, a new folder that goes when the process ends; our own cache, which is checksummed,
/// is what makes starts quick. Only the first call does anything, and it must come before the first OpenCL call. Where no folder can be
/// made, PoCL keeps its own. Folders of processes that were killed are removed.
void isolate_driver_cache(DriverCachePlace place = DriverCachePlace::Usual);

}  // namespace stokes
