// Fuzzes the importers' own reader of OBJ files.
#include <cmath>

#include "fuzz/import_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  try {
    fuzz::check_imported_mesh(read_obj_mesh(fuzz::scratch_file("a.obj", data, size)));
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).empty()) fuzz::finding("an error", "without a reason");
  }
  return 0;
}
