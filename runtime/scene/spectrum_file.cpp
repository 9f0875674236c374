// CSV files of spectra. Knows text, not what the curve is for.
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "scene/csv.h"
#include "scene/spectrum_reader.h"

namespace stokes {

std::vector<std::string> split_csv(const std::string& line, std::size_t most) {
  const char separator = line.find(',') != std::string::npos ? ',' : line.find(';') != std::string::npos ? ';' : ' ';
  std::vector<std::string> fields(1);
  for (const char c : line) {
    const bool space = c == ' ' || c == '\t' || c == '\r';
    if (c == separator || (separator == ' ' && space)) {
      if (separator != ' ' || !fields.back().empty()) {
        if (fields.size() == most) break;
        fields.emplace_back();
      }
    } else if (!space || !fields.back().empty()) {
      fields.back() += c;
    }
  }
  for (std::string& field : fields)
    while (!field.empty() && std::isspace(static_cast<unsigned char>(field.back()))) field.pop_back();
  if (separator == ' ' && fields.back().empty()) fields.pop_back();
  return fields;
}

std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') begin++;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end) return std::nullopt;
  return value;
}

std::pair<std::vector<double>, std::vector<double>> read_spectrum_file(const JsonNode& node, const std::string& path,
                                                                             const InputLimits& limits) {
  std::ifstream file(path);
  std::vector<double> wavelengths, values;
  std::string line;
  bool header_allowed = true;
  for (int number = 1; std::getline(file, line); number++) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (const auto hash = line.find('#'); hash != std::string::npos) line.resize(hash);
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto fields = split_csv(line, 4);
    const std::string where = path + ":" + std::to_string(number) + ": ";
    std::optional<double> x, y;
    if (fields.size() == 2) {
      x = parse_number(fields[0]);
      y = parse_number(fields[1]);
    }
    if (!x && header_allowed && !fields.empty() && !parse_number(fields[0])) {
      header_allowed = false;
      continue;
    }
    header_allowed = false;
    if (fields.size() != 2) node.fail(where + "expected two columns, nm and value, not " + (fields.size() < 4 ? std::to_string(fields.size()) : "more"));
    if (!x || !y) node.fail(where + "\"" + (x ? fields[1] : fields[0]) + "\" is not a number");
    if (!std::isfinite(*x) || !std::isfinite(*y)) node.fail(where + "the sample is not finite");
    if (wavelengths.size() >= limits.curve_samples)
      node.fail(where + "more than " + std::to_string(limits.curve_samples) + " samples (--limit curve-samples)");
    wavelengths.push_back(*x);
    values.push_back(*y);
  }
  return {wavelengths, values};
}

}  // namespace stokes
