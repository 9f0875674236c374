// Fuzzes the reader of checkpoints: a film in a file of its own.
#include "fuzz/film_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes::fuzz;
  const std::string bytes = film_bytes(data, size);
  read_and_use(scratch_file("a.film", bytes.data(), bytes.size()));
  return 0;
}
