// Sums of film words.
#include "device/film_words.h"

#include <cassert>

#include "layout.h"

namespace stokes {

namespace {

constexpr int kSquaresBegin = 3, kSquaresEnd = 9, kInvalid = 11;

}  // namespace

void add_film_words(Film& film, std::span<const std::int64_t> words) {
  assert(words.size() == film.words.size());
  for (std::size_t base = 0; base < words.size(); base += film.stride) {
    std::int64_t* sum = film.words.data() + base;
    const std::int64_t* term = words.data() + base;
    for (int i = 0; i < film.stride; ++i) {
      const auto before = static_cast<std::uint64_t>(sum[i]);
      const std::uint64_t after = before + static_cast<std::uint64_t>(term[i]);
      sum[i] = static_cast<std::int64_t>(after);
      // The low word of a square carries into the high word, which the next turn adds to.
      const bool is_low_word = i >= kSquaresBegin && i < kSquaresEnd && (i - kSquaresBegin) % 2 == 0;
      if (is_low_word && after < before) sum[i + 1] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum[i + 1]) + 1);
    }
  }
}

std::uint64_t count_invalid(const Film& film, std::span<const std::int64_t> words) {
  std::uint64_t count = 0;
  for (std::size_t base = 0; base < words.size(); base += film.stride) count += static_cast<std::uint64_t>(words[base + kInvalid]);
  return count;
}

}  // namespace stokes
