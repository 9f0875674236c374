// From a film's record to the files a user asked for. Knows names and formats of outputs, nothing of rendering.
#pragma once
#include <string>
#include <vector>

#include "image/film_file.h"

namespace CLI {
class App;
}

namespace stokes {

enum class OutputFormat { Exr, Png, Film };

/// By the extension: .exr, .png, .film. Throws UsageError for others.
OutputFormat output_format(const std::string& path);

struct OutputOptions {
  std::string path;
  bool png = false;       ///< also a PNG beside
  double exposure = 0;    ///< of PNGs, in stops
  bool variance = false;  ///< Variance.R, .G, .B
  bool part = false;      ///< the sums follow the EXR, for merging
  /// --png and --exposure.
  void add_picture_to(CLI::App& command);
};

/// Before any work: throws UsageError for a name that ends in no format, OutputError where the files could not be written.
void require_outputs(const OutputOptions& options);

/// A part's note that its render asked for Variance.R, .G, .B, so that the merged image gets them too.
inline constexpr const char* kVarianceNote = "stokes:variance";

/// The name of the PNG beside an output.
std::string png_beside(const std::string& path);

/// The picture of a record, with its metadata.
Image picture(const FilmRecord& record, bool variance);

/// Writes what the options ask for and returns the names of the files. Throws OutputError.
std::vector<std::string> write_outputs(const FilmRecord& record, const OutputOptions& options);

}  // namespace stokes
