// Films on disk: a checkpoint, a partial image's sums, a worker's share. Exact, checksummed, and refused when foreign.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "image/film.h"

namespace stokes {

/// What a film's sums mean: which render they belong to and which of its samples they hold.
struct FilmIdentity {
  std::string version;     ///< of the program
  std::string scene_hash;  ///< of the compiled scene, so that overrides and meshes count
  std::string scene;       ///< file name, for messages only
  std::string device;      ///< name, or "reference"
  std::string integrator;
  std::uint32_t seed = 0;
};

struct FilmRecord {
  FilmIdentity identity;
  int sample_begin = 0, sample_end = 0;  ///< the samples [begin, end) of every pixel are in the sums
  int samples_total = 0;                 ///< of the whole render
  double render_seconds = 0;
  std::uint64_t rays = 0, shadow_rays = 0, scatterings = 0, paths = 0;
  std::vector<std::pair<std::string, std::string>> notes;  ///< further metadata that the final image shall carry
  Film film;
};

/// The bytes of a record: a text header, the words in little-endian order, checksum, length, magic. Stands alone or after an EXR's end.
std::string encode_film(const FilmRecord& record);

/// Writes a record to a file of its own. Throws OutputError.
void write_film(const std::string& path, const FilmRecord& record);

/// Reads the record of a film file or of a partial EXR. Throws InputError: missing, no film in it, cut short, damaged, other version; OutOfMemory.
FilmRecord read_film(const std::string& path);

/// True when the file ends with a film's record (it may still be damaged).
bool holds_film(const std::string& path);

/// Why the sums of `found` may not be continued by (or merged with) those of `wanted`: one phrase, or empty when they may.
/// The samples are not looked at.
std::string film_mismatch(const FilmRecord& found, const FilmRecord& wanted);

/// 64-bit FNV-1a.
std::uint64_t fnv1a(const void* data, std::size_t bytes, std::uint64_t start = 0xcbf29ce484222325u);

}  // namespace stokes
