// Spectra that the importers share.
#include <array>
#include <map>

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

ImportJson metal_of(const std::string& name) {
  const auto sampled = [](const std::array<double, 7>& values) {
    return ImportJson{{"type", "sampled"}, {"wavelengths", {400, 450, 500, 550, 600, 650, 700}}, {"values", values}};
  };
  static const std::map<std::string, std::pair<std::array<double, 7>, std::array<double, 7>>> table = {
      {"Ag", {{0.05, 0.04, 0.05, 0.06, 0.055, 0.052, 0.041}, {2.104, 2.657, 3.13, 3.586, 4.01, 4.412, 4.803}}},
      {"Al", {{0.49, 0.618, 0.769, 0.958, 1.2, 1.47, 1.83}, {4.86, 5.47, 6.08, 6.69, 7.26, 7.79, 8.31}}},
      {"Au", {{1.468, 1.383, 0.916, 0.422, 0.249, 0.166, 0.161}, {1.952, 1.914, 1.84, 2.322, 2.99, 3.48, 3.962}}},
      {"Cu", {{1.31, 1.24, 1.21, 1.01, 0.48, 0.24, 0.21}, {2.13, 2.39, 2.57, 2.58, 2.98, 3.63, 4.16}}}};
  const auto it = table.find(name);
  if (it == table.end()) return nullptr;
  return {{"eta", sampled(it->second.first)}, {"k", sampled(it->second.second)}};
}

}  // namespace stokes
