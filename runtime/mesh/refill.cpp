// Holes are traced as loops of directed edges, each then triangulated at the least weight.
#include "mesh/refill.h"

#include <algorithm>
#include <map>
#include <set>

namespace stokes {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Loop = std::vector<std::uint32_t>;

constexpr double kNever = 1e30;

// The boundaries of a set of faces, turning as the faces do; none when one passes a vertex twice.
std::vector<Loop> boundaries(const std::vector<Triangle>& faces) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : faces)
    for (int i = 0; i < 3; i++) edges.insert({t[i], t[(i + 1) % 3]});
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a}) && !next.emplace(a, b).second) return {};
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    std::uint32_t v = next.begin()->first;
    for (auto at = next.find(v); at != next.end(); at = next.find(v)) {
      loop.push_back(v);
      v = at->second;
      next.erase(at);
    }
    if (v != loop.front()) return {};
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<Triangle> refill(const std::vector<Triangle>& removed, std::size_t most,
                             const std::function<double(std::uint32_t, std::uint32_t, std::uint32_t)>& weight,
                             const std::function<bool(std::uint32_t, std::uint32_t)>& free) {
  std::vector<Triangle> added;
  for (const Loop& loop : boundaries(removed)) {
    const std::size_t n = loop.size();
    if (n > most) return {};
    // best[i n + j]: the least weight of the part between vertices i and j; its third corner in via.
    std::vector<double> best(n * n, 0);
    std::vector<std::size_t> via(n * n, 0);
    for (std::size_t span = 2; span < n; span++)
      for (std::size_t i = 0; i + span < n; i++) {
        const std::size_t j = i + span;
        best[i * n + j] = kNever;
        if (span < n - 1 && !free(loop[i], loop[j])) continue;
        for (std::size_t k = i + 1; k < j; k++) {
          const double parts = best[i * n + k] + best[k * n + j];
          if (parts >= best[i * n + j]) continue;
          const double all = parts + weight(loop[i], loop[k], loop[j]);
          if (all < best[i * n + j]) best[i * n + j] = all, via[i * n + j] = k;
        }
      }
    if (n < 3 || best[n - 1] >= kNever) return {};
    std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = via[i * n + j];
      added.push_back({loop[i], loop[k], loop[j]});
      open.insert(open.end(), {{i, k}, {k, j}});
    }
  }
  return added;
}

}  // namespace stokes
