// Values of options from their text. Everything here throws UsageError naming the option.
#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cli/commands.h"
#include "layout.h"

namespace stokes {
namespace {

double to_number(const std::string& option, const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) throw UsageError(option + ": '" + text + "' is not a number");
  return value;
}

int to_integer(const std::string& option, const std::string& text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) throw UsageError(option + ": '" + text + "' is not a whole number");
  return value;
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

double parse_duration(const std::string& option, const std::string& text) {
  const std::size_t unit_at = std::min(text.size(), text.find_first_not_of("0123456789.+-eE"));
  const std::string unit = text.substr(unit_at);
  double scale = 0;
  if (unit.empty() || unit == "s") scale = 1;
  if (unit == "ms") scale = 1e-3;
  if (unit == "m" || unit == "min") scale = 60;
  if (unit == "h") scale = 3600;
  if (scale == 0) throw UsageError(option + ": '" + text + "' has no unit that is known; use ms, s, m or h");
  const double seconds = to_number(option, text.substr(0, unit_at)) * scale;
  if (seconds <= 0) throw UsageError(option + ": '" + text + "' is not a positive time" + (option == "--checkpoint" ? "; 'none' is without checkpoints" : ""));
  return seconds;
}

std::pair<int, int> parse_size(const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() != 2) throw UsageError("--size: '" + text + "' is not WIDTHxHEIGHT, as in 640x480");
  const int width = to_integer("--size", parts[0]), height = to_integer("--size", parts[1]);
  if (width < 1 || height < 1 || width > 65536 || height > 65536) throw UsageError("--size: '" + text + "' is outside 1x1 to 65536x65536");
  return {width, height};
}

PixelWindow parse_crop(const std::string& text, int width, int height) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 4) throw UsageError("--crop: '" + text + "' is not x0,x1,y0,y1");
  double v[4];
  for (std::size_t i = 0; i < 4; i++) v[i] = to_number("--crop", parts[i]);
  const bool fractions = std::all_of(v, v + 4, [](double x) { return x <= 1; });
  const int size[4] = {width, width, height, height};
  int pixels[4];
  for (int i = 0; i < 4; i++) {
    if (!fractions && v[i] != std::floor(v[i])) throw UsageError("--crop: '" + text + "' mixes fractions and pixels");
    const double at = fractions ? std::round(v[i] * size[i]) : v[i];
    if (at < 0 || at > size[i])
      throw UsageError("--crop: '" + text + "' leaves the image of " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
    pixels[i] = static_cast<int>(at);
  }
  if (pixels[0] >= pixels[1] || pixels[2] >= pixels[3]) throw UsageError("--crop: '" + text + "' holds no pixel");
  return {pixels[0], pixels[1], pixels[2], pixels[3]};
}

std::pair<int, int> parse_samples(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 2) throw UsageError("--samples: '" + text + "' is not a:b, as in 0:64");
  const int begin = to_integer("--samples", parts[0]), end = to_integer("--samples", parts[1]);
  if (begin < 0 || end <= begin) throw UsageError("--samples: '" + text + "' is empty; it must be a:b with 0 <= a < b");
  return {begin, end};
}

SpectralBins parse_spectral(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 3) throw UsageError("--spectral: '" + text + "' is not a:b:n, as in 400:700:31");
  const double begin = to_number("--spectral", parts[0]), end = to_number("--spectral", parts[1]);
  const int count = to_integer("--spectral", parts[2]);
  if (begin < 280 || end > 780 || begin >= end) throw UsageError("--spectral: '" + text + "' is no range within 280 to 780 nm");
  if (count < 1 || count > 1000) throw UsageError("--spectral: '" + text + "' must ask for 1 to 1000 bins");
  return {count, begin, end};
}

AovChoice parse_aovs(const std::string& text) {
  AovChoice choice;
  for (const std::string& name : split(text, ',')) {
    if (name == "albedo")
      choice.channels |= FILM_ALBEDO;
    else if (name == "normal")
      choice.channels |= FILM_NORMAL;
    else if (name == "depth")
      choice.channels |= FILM_DEPTH;
    else if (name == "fluorescence")
      choice.channels |= FILM_FLUORESCENCE;
    else if (name == "variance")
      choice.variance = true;
    else if (name == "all")
      choice = {FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH | FILM_FLUORESCENCE, true};
    else
      throw UsageError("--aov: '" + name + "' is none of albedo, normal, depth, variance, fluorescence, all");
  }
  return choice;
}

std::pair<std::string, std::string> parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (text.empty() || text[0] != '/' || equals == std::string::npos)
    throw UsageError("--set: '" + text + "' is not /json/pointer=VALUE, as in /camera/vfov=40");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

IntegratorKind parse_integrator(const std::string& name) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '_', ' ');
  struct Name {
    const char* name;
    IntegratorKind kind;
  };
  static constexpr Name kNames[] = {
      {"mis", IntegratorKind::Mis},           {"path tracer mis", IntegratorKind::Mis},
      {"nee", IntegratorKind::Nee},           {"path tracer nee", IntegratorKind::Nee},
      {"mats", IntegratorKind::Mats},         {"path tracer mats", IntegratorKind::Mats},
      {"normals", IntegratorKind::Normals},   {"ao", IntegratorKind::Ao},
      {"fluorescent mis", IntegratorKind::Mis}, {"fluorescent mats", IntegratorKind::Mats},
      {"path tracer volumetric", IntegratorKind::Mats}, {"path tracer volumetric mats", IntegratorKind::Mats},
      {"path tracer volumetric nee", IntegratorKind::Nee}, {"path tracer volumetric mis", IntegratorKind::Mis}};
  for (const Name& known : kNames)
    if (plain == known.name) return known.kind;
  throw UsageError("--integrator: '" + name + "' is none of mis, nee, mats, normals, ao (or their names in scene files)");
}

}  // namespace stokes
