// The machine's free memory. Knows nothing of who asks.
#pragma once
#include <cstdint>
#include <string>

namespace stokes {

/// Bytes that the host can still give, or 0 when that is not known.
std::uint64_t available_memory();

/// "1.25 GiB".
std::string gibibytes(std::uint64_t bytes);

}  // namespace stokes
