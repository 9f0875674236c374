// Fuzzes the import of Mitsuba 3's files.
#include "fuzz/import_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  stokes::fuzz::import_and_read("a.xml", data, size, stokes::import_mitsuba);
  return 0;
}
