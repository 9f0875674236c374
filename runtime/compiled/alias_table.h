// Drawing an index with given weights in constant time (Walker's alias method, built as Vose 1991 does).
#pragma once
#include <cstdint>
#include <vector>

namespace stokes::compiled {

struct AliasEntry {
  double probability = 0;  ///< of the index being drawn; they sum to 1
  double threshold = 1;    ///< keep the index when the fraction is below this, else take the alias
  std::uint32_t alias = 0;
};

/// Weights are not negative and not all zero.
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights);

}  // namespace stokes::compiled
