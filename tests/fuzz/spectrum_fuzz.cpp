// Fuzzes the files of spectra and of reradiation matrices: any bytes give increasing wavelengths and finite values, or a scene error.
#include <cmath>

#include "fuzz/checks.h"
#include "fuzz/scratch_file.h"
#include "scene/read_scene.h"

namespace {

void check_curve(const stokes::Spectrum& s) {
  if (s.wavelengths.empty() || s.wavelengths.size() != s.values.size()) stokes::fuzz::finding("a curve", "of unequal columns");
  for (std::size_t i = 0; i < s.values.size(); i++)
    if (!std::isfinite(s.wavelengths[i]) || !std::isfinite(s.values[i]) || (i > 0 && !(s.wavelengths[i] > s.wavelengths[i - 1])))
      stokes::fuzz::finding("a curve", "that is out of order or not finite");
}

void check_matrix(const stokes::ReradiationMatrix& m) {
  if (m.values.size() != m.li.size() * m.lo.size()) stokes::fuzz::finding("a matrix", "of another size than its bands");
  for (const double v : m.values)
    if (!std::isfinite(v)) stokes::fuzz::finding("a matrix", "with a value that is not finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  static const std::string curve = R"({"camera": {}, "background": {"type": "file", "filename": "a.csv"}})";
  static const std::string matrix = R"({"camera": {}, "materials": [{"type": "reradiation", "name": "m", "filename": "a.csv"}]})";
  fuzz::scratch_file("a.csv", data, size);
  for (const std::string* scene : {&curve, &matrix}) try {
      const SceneDescription read = read_scene_text(*scene, "scene.json", fuzz::scratch_folder());
      if (read.background.emission) check_curve(*read.background.emission);
      for (const MaterialPtr& m : read.materials) check_matrix(*m->matrix);
    } catch (const SceneError& error) {
      fuzz::check_scene_error(error.what(), "scene.json");
    }
  return 0;
}
