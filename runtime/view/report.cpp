// Two renders side by side as one HTML file. See report.h. The names in the JSON are report.js's.
#include "view/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "view/frame.h"
#include "view/pages.h"

namespace stokes {
namespace {

using Json = nlohmann::ordered_json;
using Planes = std::vector<std::vector<float>>;

constexpr int kCells = 64;
constexpr double kVisible = 5;  // uncertainties: below, a mean squared error is not told from the noise of the truth
constexpr const char* kColors[3] = {"R", "G", "B"};

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; k++) three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; k++) text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string encode(const Planes& planes, int width, int height) { return base64(encode_planes(planes, width, height, 0, 0)); }

std::string encode_colors(const Image& image) {
  Planes planes;
  for (const char* name : kColors) planes.push_back(image.find(name)->values);
  return encode(planes, image.width, image.height);
}

/// Of R, G and B the z-score of each pixel's difference that is largest in size; nothing where an image lacks variances.
Json score_map(const Image& a, const Image& b) {
  std::vector<float> scores(a.find("R")->values.size(), 0.0f);
  for (const char* name : kColors) {
    const Image::Channel *va = a.find(std::string("Variance.") + name), *vb = b.find(std::string("Variance.") + name);
    if (!va || !vb) return {};
    const std::vector<float>&ma = a.find(name)->values, &mb = b.find(name)->values;
    for (std::size_t i = 0; i < scores.size(); i++) {
      const float sigma = std::sqrt(va->values[i] + vb->values[i]), z = sigma > 0 ? (ma[i] - mb[i]) / sigma : 0;
      if (std::fabs(z) > std::fabs(scores[i])) scores[i] = z;
    }
  }
  return encode({scores}, a.width, a.height);
}

/// Centres of the spectral channels in nm, in the image's order.
std::vector<std::pair<double, const Image::Channel*>> spectral_channels(const Image& image) {
  std::vector<std::pair<double, const Image::Channel*>> found;
  for (const Image::Channel& channel : image.channels) {
    int whole = 0, fraction = 0;
    if (std::sscanf(channel.name.c_str(), "S0.%d,%6dnm", &whole, &fraction) == 2) found.emplace_back(whole + fraction * 1e-6, &channel);
  }
  return found;
}

Planes cell_means(const std::vector<std::pair<double, const Image::Channel*>>& channels, int width, int height, int edge) {
  const int columns = (width + edge - 1) / edge, rows = (height + edge - 1) / edge;
  Planes planes;
  for (const auto& [nm, channel] : channels) {
    std::vector<float> cells;
    for (int row = 0; row < rows; row++)
      for (int column = 0; column < columns; column++) {
        double sum = 0;
        int count = 0;
        for (int y = row * edge; y < std::min(height, (row + 1) * edge); y++)
          for (int x = column * edge; x < std::min(width, (column + 1) * edge); x++, count++)
            sum += static_cast<double>(channel->values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
        cells.push_back(static_cast<float>(sum / count));
      }
    planes.push_back(std::move(cells));
  }
  return planes;
}

Json describe_spectra(const Image& a, const Image& b) {
  const auto in_a = spectral_channels(a), in_b = spectral_channels(b);
  if (in_a.size() < 2 || in_a.size() != in_b.size()) return {};
  for (std::size_t i = 0; i < in_a.size(); i++)
    if (in_a[i].first != in_b[i].first) return {};
  const double half = 0.5 * (in_a[1].first - in_a[0].first);
  const int edge = (std::max(a.width, a.height) + kCells - 1) / kCells, columns = (a.width + edge - 1) / edge, rows = (a.height + edge - 1) / edge;
  return {{"begin", in_a.front().first - half}, {"end", in_a.back().first + half}, {"edge", edge},
          {"a", encode(cell_means(in_a, a.width, a.height, edge), columns, rows)}, {"b", encode(cell_means(in_b, a.width, a.height, edge), columns, rows)}};
}

std::string short_number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

Json describe_numbers(const ReportCase& c) {
  const ImageDifference& d = c.difference;
  Json rows = Json::array();
  const auto add = [&](const std::string& name, const std::string& value) { rows.push_back({name, value}); };
  add("MSE", short_number(d.mse));
  add("relMSE", short_number(d.relative_mse));
  add("FLIP", short_number(d.flip));
  add("Largest difference", short_number(d.largest) + " at " + std::to_string(d.largest_x) + ", " + std::to_string(d.largest_y));
  for (int i = 0; i < 3; i++) add(std::string("Mean of ") + kColors[i], short_number(d.mean_a[i]) + " and " + short_number(d.mean_b[i]));
  if (d.not_finite > 0) add("Values that are not finite", std::to_string(d.not_finite));
  if (c.parity) {
    const ParityResult& p = *c.parity;
    add("Tests", std::to_string(p.tests) + ", of blocks of " + std::to_string(p.block) + " pixels and of means");
    add("Largest |z|", short_number(std::fabs(p.worst.z)) + ", threshold " + short_number(p.threshold));
    add("p", short_number(p.p));
    for (const ParityTest& t : p.means) add("z of the mean of " + t.channel, short_number(t.z));
    if (!p.rejected.empty()) add("Blocks and means that part", std::to_string(p.rejected.size()));
  }
  for (const auto& [side, image] : {std::pair{"A", &c.a}, std::pair{"B", &c.b}})
    for (const auto& [key, value] : image->metadata)
      if (key == "stokes:device" || key == "stokes:samples" || key == "stokes:seed")
        add(std::string(side) + ": " + key.substr(7), value);
      else if (key == "stokes:render_seconds")
        add(std::string(side) + ": rendered in", short_number(std::strtod(value.c_str(), nullptr)) + " s");
  return rows;
}

std::string verdict(const ReportCase& c) {
  if (c.difference.not_finite > 0) return "Different: there are values that are not finite";
  if (c.difference.identical) return "Identical";
  if (c.parity) return c.parity->agree ? "They agree within their noise" : "They differ by more than their noise";
  return c.different ? "Different" : "Within the limits";
}

Json describe_case(const ReportCase& c) {
  Json j;
  j["name"] = c.name;
  j["name_a"] = c.name_a;
  j["name_b"] = c.name_b;
  j["different"] = c.different;
  j["verdict"] = verdict(c);
  j["a"] = encode_colors(c.a);
  j["b"] = encode_colors(c.b);
  j["z"] = score_map(c.a, c.b);
  j["spectra"] = describe_spectra(c.a, c.b);
  j["numbers"] = describe_numbers(c);
  j["largest"] = {c.difference.largest_x, c.difference.largest_y};
  j["convergence"] = Json::array();
  for (const ConvergencePoint& p : c.convergence) j["convergence"].push_back({p.samples, p.error});
  return j;
}

}  // namespace

double convergence_error(const Film& film, const Film& truth) {
  double sum = 0, squares = 0;
  for (int y = 0; y < film.height; y++)
    for (int x = 0; x < film.width; x++) {
      double pixel = 0;  // its channels share their samples, so the pixel is what is independent
      for (int c = 0; c < 3; c++) {
        const double d = film_mean(film, x, y, c) - film_mean(truth, x, y, c);
        pixel += (d * d - film_variance(truth, x, y, c)) / 3;
      }
      sum += pixel;
      squares += pixel * pixel;
    }
  const double count = static_cast<double>(film.width) * film.height, mean = sum / count;
  const double uncertainty = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  return mean > kVisible * uncertainty ? std::sqrt(mean) : 0;
}

std::string comparison_report(const std::string& title, const std::vector<ReportCase>& cases) {
  Json data;
  data["title"] = title;
  data["cases"] = Json::array();
  for (const ReportCase& c : cases) data["cases"].push_back(describe_case(c));
  const std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string escaped;  // nothing in it may end the element that it stands in
  for (const char c : json) c == '<' ? escaped += "\\u003c" : escaped += c;
  std::string page = page_files().at("report.html");
  const std::string mark = "<!-- data -->";
  return page.replace(page.find(mark), mark.size(), "<script type=\"application/json\" id=\"data\">" + escaped + "</script>");
}

}  // namespace stokes
