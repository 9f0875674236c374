// Triangulations of the holes that faces would leave behind. Knows nothing of where the surface should lie.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace stokes {

/// The faces with the corners' least sum of weights that close every hole which taking `removed` away would leave in a closed mesh, without
/// new vertices (dynamic programming over each hole's boundary, Barequet & Sharir 1995). `free(a, b)`: no face that stays has that edge.
/// Empty when a boundary touches itself, is longer than `most` edges, or has no triangulation by free edges.
std::vector<std::array<std::uint32_t, 3>> refill(const std::vector<std::array<std::uint32_t, 3>>& removed, std::size_t most,
                                                 const std::function<double(std::uint32_t, std::uint32_t, std::uint32_t)>& weight,
                                                 const std::function<bool(std::uint32_t, std::uint32_t)>& free);

}  // namespace stokes
