// Fuzzes the reader of PLY files, whose meshes the importers write as OBJ.
#include <cmath>

#include "fuzz/import_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  try {
    const ImportedMesh mesh = read_ply(fuzz::scratch_file("a.ply", data, size));
    fuzz::check_imported_mesh(mesh);
    for (const auto& p : mesh.positions)
      for (const double x : p)
        if (!std::isfinite(x)) fuzz::finding("a mesh", "with a position that is not finite");
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).empty()) fuzz::finding("an error", "without a reason");
  }
  return 0;
}
