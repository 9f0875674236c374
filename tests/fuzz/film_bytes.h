// What is common to the targets that read films: the bytes may get a right checksum, and a film that is read must be usable.
#pragma once
#include <cstring>
#include <string>

#include "fuzz/checks.h"
#include "fuzz/scratch_file.h"
#include "image/error.h"
#include "image/film_file.h"

namespace stokes::fuzz {

/// With a first byte that is odd the rest as it is; else with a trailer that fits it, so that what lies behind the checksum is reached.
inline std::string film_bytes(const unsigned char* data, std::size_t size) {
  if (size == 0) return {};
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] & 1) return bytes;
  const std::uint64_t words[2] = {fnv1a(bytes.data(), bytes.size()), bytes.size() + 24};
  bytes.append(reinterpret_cast<const char*>(words), sizeof words);
  return bytes.append("STKSFILM");
}

/// Reads a file and uses what it holds.
inline void read_and_use(const std::string& path) {
  const bool holds = holds_film(path);
  try {
    const FilmRecord record = read_film(path);
    if (!holds) finding("a film", "in a file that holds none");
    const Image image = develop(record.film, true);
    const FilmTotals totals = film_totals(record.film);
    if (image.find("R")->values.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) finding("an image", "of another size");
    if (totals.invalid > 0 && totals.first_invalid_x < record.film.crop_x) finding("an invalid pixel", "outside the window");
    FilmRecord twice = record;
    film_accumulate(twice.film, record.film);
    if (!film_mismatch(record, record).empty()) finding("a film", "that does not belong to itself");
  } catch (const InputError& error) {
    const std::string line = error.what();
    if (!line.starts_with(path) || line.size() > path.size() + 1000) finding("an error without its file, or very long", line);
  }
}

}  // namespace stokes::fuzz
