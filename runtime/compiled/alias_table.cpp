// See alias_table.h.
#include "compiled/alias_table.h"

namespace stokes::compiled {

std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights) {
  const std::size_t n = weights.size();
  double total = 0;
  for (double w : weights) total += w;
  std::vector<AliasEntry> table(n);
  std::vector<double> height(n);
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < n; i++) {
    table[i].probability = weights[i] / total;
    table[i].alias = i;
    height[i] = table[i].probability * double(n);
    (height[i] < 1 ? small : large).push_back(i);
  }

  // Each column below the mean is filled up from one above it.
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    table[s].threshold = height[s];
    table[s].alias = l;
    height[l] -= 1 - height[s];
    if (height[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  return table;  // what remains differs from a full column by rounding alone
}

}  // namespace stokes::compiled
