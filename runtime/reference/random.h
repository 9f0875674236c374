// The reference's own random numbers: xoshiro256** (Blackman & Vigna 2018), one stream per sample of a pixel. Knows nothing of scenes,
// and is another generator than the kernels' on purpose.
#pragma once
#include <cstdint>

namespace stokes::reference {

/// SplitMix64: a well mixed 64-bit successor of `state`.
inline std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// A stream of uniform numbers that is keyed by seed, pixel and sample alone.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) {
    std::uint64_t key = seed;
    key = splitmix(key) ^ pixel;
    key = splitmix(key) ^ sample;
    for (std::uint64_t& word : state_) word = splitmix(key);
  }

  /// Uniform in [0, 1), 53 bits.
  double next() { return static_cast<double>(next_bits() >> 11) * 0x1p-53; }

 private:
  static std::uint64_t rotate_left(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

  std::uint64_t next_bits() {
    const std::uint64_t result = rotate_left(state_[1] * 5, 7) * 9;
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate_left(state_[3], 45);
    return result;
  }

  std::uint64_t state_[4];
};

}  // namespace stokes::reference
