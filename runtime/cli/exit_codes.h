// The process's exit codes. Render farms act on them; they are part of the interface.
#pragma once

namespace stokes {

enum ExitCode {
  kExitDone = 0,         ///< the output exists, is complete and finite
  kExitInternal = 1,     ///< an internal error, or invalid (NaN, infinite) samples
  kExitBadInput = 2,     ///< bad scene or input
  kExitDevice = 3,       ///< no usable device, or an OpenCL failure
  kExitMemory = 4,       ///< out of memory
  kExitOutput = 5,       ///< an output cannot be written; the old file is intact
  kExitInterrupted = 6,  ///< interrupted, and the checkpoint is saved; status: parts are open
  kExitDifferent = 7,    ///< compare or parity found a difference
  kExitUsage = 64        ///< bad command line
};

}  // namespace stokes
