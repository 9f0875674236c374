// Adds what a device has summed to a film. Knows which words are wide; no OpenCL.
#pragma once
#include <cstdint>
#include <span>

#include "image/film.h"

namespace stokes {

/// Adds `words`, laid out as the film's, to the film: exact integer sums, 128 bits wide for the squares.
void add_film_words(Film& film, std::span<const std::int64_t> words);

/// The invalid samples that `words` count.
std::uint64_t count_invalid(const Film& film, std::span<const std::int64_t> words);

}  // namespace stokes
