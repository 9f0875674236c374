// The kernels' source files by name, from the binary or from a folder, and their assembly into one program text. Knows no OpenCL.
#pragma once
#include <map>
#include <string>

namespace stokes {

/// File name ("render.cl") to contents.
using KernelFiles = std::map<std::string, std::string>;

/// The files of kernels/ as they were when this binary was built.
const KernelFiles& embedded_kernels();

/// Every *.cl and *.h of a folder. Throws DeviceError if it cannot be read or holds none.
KernelFiles read_kernel_dir(const std::string& folder);

/// One program text: `prologue` (the build constants), then `root` with every `#include "file"` replaced by that file, each file
/// once. `#line N "file"` stands wherever the place changes, so a compiler's messages name the true file and line.
/// Throws KernelBuildError, with file and line, if an included file is missing.
std::string assemble_program(const KernelFiles& files, const std::string& root, const std::string& prologue);

}  // namespace stokes
