// Reads dyes and measured reradiation matrices.
#include <cmath>
#include <exception>
#include <fstream>

#include "scene/bispectral_exr.h"
#include "scene/csv.h"
#include "scene/material_reader.h"
#include "scene/spectrum_reader.h"

namespace stokes {
namespace {

// A measurement as fine as 0.1 nm over the whole range is larger than any known one.
constexpr std::size_t kMaxBands = 5000;

void check_bands(const JsonNode& node, const std::string& path, const std::vector<double>& bands, const char* what) {
  if (bands.size() < 2) node.fail(path + ": there must be at least two " + what + " bands");
  const double step = bands[1] - bands[0];
  for (std::size_t i = 1; i < bands.size(); i++)
    if (!(step > 0) || std::abs(bands[i] - bands[i - 1] - step) > 1e-6 * step)
      node.fail(path + ": " + what + " bands must increase in equal steps, and " + show(bands[i]) + " follows " + show(bands[i - 1]));
}

std::shared_ptr<const ReradiationMatrix> read_reradiation_exr(const JsonNode& node, const std::string& path) {
  try {
    auto matrix = std::make_shared<ReradiationMatrix>(read_bispectral_exr(path));
    check_bands(node, path, matrix->li, "incoming");
    check_bands(node, path, matrix->lo, "outgoing");
    return matrix;
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& error) {
    node.fail(path + ": " + error.what());
  }
}

}  // namespace

DyeDescription read_dye(ReadContext& context, const JsonObject& o, bool medium) {
  DyeDescription dye;
  dye.pointer = o.node().pointer();
  dye.absorption = read_spectrum(context, o.require("absorption"), SpectrumRole::Dye, medium ? kNotNegative : kUnitInterval);
  const JsonNode emission = o.require("emission");
  dye.emission = read_spectrum(context, emission, SpectrumRole::Dye, kNotNegative);
  bool emits = false;
  for (int lambda = 280; lambda <= 780; lambda++) emits |= plain_value(*dye.emission, SpectrumRole::Dye, lambda) > 0;
  if (!emits) emission.fail("the emission is zero everywhere from 280 to 780 nm");
  dye.yield = o.number("yield", 1, kUnitInterval);
  dye.concentration = o.number("concentration", 1, medium ? kNotNegative : kUnitInterval);
  if (const auto type = o.find("yield_type")) {
    const std::string name = type->string();
    if (name != "photon" && name != "energy") type->fail("expected \"photon\" or \"energy\", not \"" + name + "\"");
    dye.photon_yield = name == "photon";
  }
  dye.stokes = o.boolean("stokes", false);
  return dye;
}

std::vector<DyeDescription> read_dyes(ReadContext& context, const JsonNode& list, bool medium) {
  if (!list.is_array()) list.fail_type("an array of dyes");
  std::vector<DyeDescription> dyes;
  for (std::size_t i = 0; i < list.size(); i++) {
    const JsonObject o(list[i], "a dye", {"name", "absorption", "emission", "yield", "yield_type", "concentration", "stokes"});
    dyes.push_back(read_dye(context, o, medium));
  }
  if (dyes.empty()) list.fail("there must be at least one dye");
  return dyes;
}

std::shared_ptr<const ReradiationMatrix> read_reradiation_file(const JsonNode& node, const std::string& path) {
  if (path.ends_with(".exr")) return read_reradiation_exr(node, path);
  auto matrix = std::make_shared<ReradiationMatrix>();
  matrix->filename = path;
  std::ifstream file(path);
  std::string line;
  bool has_header = false;
  for (int number = 1; std::getline(file, line); number++) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.starts_with("#") || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = path + ":" + std::to_string(number) + ": ";
    const auto fields = split_csv(line, kMaxBands + 2);
    std::vector<double> row;
    // The corner of the table is a label.
    for (std::size_t i = has_header ? 0 : 1; i < fields.size(); i++) {
      const auto value = parse_number(fields[i]);
      if (!value || !std::isfinite(*value)) node.fail(where + "\"" + fields[i] + "\" is not a finite number");
      row.push_back(*value);
    }
    if (!has_header) {
      if (row.size() > kMaxBands) node.fail(path + ": more than " + std::to_string(kMaxBands) + " bands");
      matrix->li = row;
      has_header = true;
      continue;
    }
    if (row.size() != matrix->li.size() + 1)
      node.fail(where + std::to_string(row.size()) + " columns, where the first row has " + std::to_string(matrix->li.size() + 1));
    matrix->lo.push_back(row[0]);
    matrix->values.insert(matrix->values.end(), row.begin() + 1, row.end());
    if (matrix->lo.size() > kMaxBands)
      node.fail(path + ": more than " + std::to_string(kMaxBands) + " bands");
  }
  check_bands(node, path, matrix->li, "incoming");
  check_bands(node, path, matrix->lo, "outgoing");
  return matrix;
}

}  // namespace stokes
