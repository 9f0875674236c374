// Spectra that the importers share.
#include <initializer_list>

#include "import/imported_scene.h"

namespace stokes {

ImportJson scaled(ImportJson spectrum, double factor) {
  if (factor == 1) return spectrum;
  if (spectrum.is_number()) return spectrum.get<double>() * factor;
  if (spectrum.is_array()) {
    for (ImportJson& component : spectrum) component = component.get<double>() * factor;
    return spectrum;
  }
  spectrum["scale"] = spectrum.value("scale", 1.0) * factor;
  return spectrum;
}

ImportJson metal_of(bool gold) {
  const auto sampled = [](std::initializer_list<double> values) {
    return ImportJson{{"type", "sampled"}, {"wavelengths", {400, 450, 500, 550, 600, 650, 700}}, {"values", values}};
  };
  if (gold)
    return {{"eta", sampled({1.468, 1.383, 0.916, 0.422, 0.249, 0.166, 0.161})}, {"k", sampled({1.952, 1.914, 1.84, 2.322, 2.99, 3.48, 3.962})}};
  return {{"eta", sampled({0.05, 0.04, 0.05, 0.06, 0.055, 0.052, 0.041})}, {"k", sampled({2.104, 2.657, 3.13, 3.586, 4.01, 4.412, 4.803})}};
}

}  // namespace stokes
