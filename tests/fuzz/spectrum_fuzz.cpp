// Fuzzes the files of spectra and of reradiation matrices: any bytes give increasing wavelengths and finite values in range, or a scene error.
#include <cmath>

#include "fuzz/checks.h"
#include "fuzz/lone_node.h"
#include "fuzz/scratch_file.h"
#include "scene/material_reader.h"
#include "scene/spectrum_reader.h"

namespace {

using stokes::fuzz::finding;

void check_increasing(const std::vector<double>& wavelengths, const char* what) {
  for (std::size_t i = 0; i < wavelengths.size(); i++)
    if (!std::isfinite(wavelengths[i]) || (i > 0 && !(wavelengths[i] > wavelengths[i - 1]))) finding(what, "that is out of order or not finite");
}

void check_curve(const stokes::Spectrum& s) {
  if (s.wavelengths.empty() || s.wavelengths.size() != s.values.size()) finding("a curve", "of unequal columns");
  check_increasing(s.wavelengths, "a curve");
  for (const double v : s.values)
    if (!std::isfinite(v)) finding("a curve", "with a value that is not finite");
  for (int lambda = 280; lambda <= 780; lambda += 10)
    if (const double v = stokes::plain_value(s, stokes::SpectrumRole::Emission, lambda); !(v >= 0) || !std::isfinite(v)) finding("a curve", "with a value out of range");
}

void check_matrix(const stokes::ReradiationMatrix& m) {
  if (m.li.size() < 2 || m.lo.size() < 2 || m.values.size() != m.li.size() * m.lo.size()) finding("a matrix", "of another size than its bands");
  check_increasing(m.li, "a matrix");
  check_increasing(m.lo, "a matrix");
  for (const double v : m.values)
    if (!std::isfinite(v)) finding("a matrix", "with a value that is not finite");
}

// Runs a reader; what it refuses must be one clear line.
template <class Read>
void read(const Read& reader) {
  try {
    reader();
  } catch (const stokes::SceneError& error) {
    stokes::fuzz::check_scene_error(error.what(), "scene.json");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace stokes;
  static const fuzz::LoneNode curve(R"({"type": "file", "filename": "a.csv"})"), matrix(R"("a.csv")");
  fuzz::scratch_file("a.csv", data, size);
  SceneDescription scene;
  ReadContext context = curve.context(scene);
  read([&] { check_curve(*read_spectrum(context, curve.node(), SpectrumRole::Emission, kNotNegative)); });
  read([&] { check_matrix(*read_reradiation_file(matrix.node(), context.file_path(matrix.node(), FileSort::Table))); });
  return 0;
}
