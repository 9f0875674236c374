// Fuzzes the reader of partial images: a film behind an image's end. What is fuzzed follows some bytes that look like an EXR; the length in
// the trailer says where it begins, and every sixteenth input reaches into them.
#include "fuzz/film_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes::fuzz;
  std::string bytes = film_bytes(data, size);
  if (size > 0 && data[0] % 16 == 0 && bytes.size() >= 16) bytes[bytes.size() - 16] = static_cast<char>(bytes[bytes.size() - 16] + data[0] / 16);
  bytes.insert(0, std::string("\x76\x2f\x31\x01\x02\0\0\0channels\0chlist\0", 24) + std::string(40, 'x'));
  read_and_use(scratch_file("a.exr", bytes.data(), bytes.size()));
  return 0;
}
