// From a film's record to the files a user asked for. Knows names and formats of outputs, nothing of rendering.
#include "cli/outputs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "cli/commands.h"
#include "image/image_file.h"
#include "image/replace_file.h"

namespace stokes {

OutputFormat output_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".exr") return OutputFormat::Exr;
  if (extension == ".png") return OutputFormat::Png;
  if (extension == ".film") return OutputFormat::Film;
  throw UsageError("-o: '" + path + "' ends in none of .exr, .png, .film");
}

void OutputOptions::add_picture_to(CLI::App& command) {
  command.add_flag("--png", png, "Also write an 8-bit sRGB PNG beside");
  command.add_option("--exposure", exposure, "Stops, for the PNG")->capture_default_str();
}

std::string png_beside(const std::string& path) { return std::filesystem::path(path).replace_extension(".png").string(); }

void require_outputs(const OutputOptions& options) {
  const OutputFormat format = output_format(options.path);
  require_writable(options.path);
  if (options.png) require_writable(png_beside(options.path));
  if (format != OutputFormat::Film || options.png) require_image_writer();
}

Image picture(const FilmRecord& record, bool variance) {
  Image image = develop(record.film, variance);
  const auto note = [&](const char* name, const std::string& value) { image.metadata.emplace_back(name, value); };
  const int samples = record.sample_end - record.sample_begin;
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.6g", record.render_seconds);
  note("Software", "stokes " + record.identity.version);
  note("stokes:version", record.identity.version);
  note("stokes:scene", record.identity.scene);
  note("stokes:scene_hash", record.identity.scene_hash);
  note("stokes:seed", std::to_string(record.identity.seed));
  note("stokes:samples", std::to_string(samples));
  if (record.sample_begin > 0 || record.sample_end != record.samples_total)
    note("stokes:sample_range", std::to_string(record.sample_begin) + ":" + std::to_string(record.sample_end) + " of " +
                                    std::to_string(record.samples_total));
  note("stokes:device", record.identity.device);
  note("stokes:integrator", record.identity.integrator);
  note("stokes:render_seconds", seconds);
  // A part's notes are a stranger's: others' names are an encoder's orders, such as a compression with losses.
  for (const auto& [name, value] : record.notes)
    if (name.starts_with("stokes:")) image.metadata.emplace_back(name, value);
  return image;
}

std::vector<std::string> write_outputs(const FilmRecord& record, const OutputOptions& options) {
  std::vector<std::string> written;
  const OutputFormat format = output_format(options.path);
  const Image image = picture(record, options.variance);
  if (format == OutputFormat::Film) write_film(options.path, record);
  if (format == OutputFormat::Exr) write_exr(options.path, image, options.part ? encode_film(record) : std::string());
  if (format == OutputFormat::Png) write_png(options.path, image, options.exposure);
  written.push_back(options.path);
  if (options.png && format != OutputFormat::Png) {
    written.push_back(png_beside(options.path));
    write_png(written.back(), image, options.exposure);
  }
  return written;
}

}  // namespace stokes
