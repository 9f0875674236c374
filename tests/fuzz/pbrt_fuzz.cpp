// Fuzzes the import of pbrt-v4's files.
#include "fuzz/import_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  stokes::fuzz::import_and_read("a.pbrt", data, size, stokes::import_pbrt);
  return 0;
}
