// Runs a loop over indices on all cores, in chunks.
#pragma once
#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace stokes {

/// Calls body(i) for every i below count, on several threads; body must write to nothing that another index touches.
template <class Body>
void in_parallel(std::size_t count, const Body& body) {
  const std::size_t threads = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  std::vector<std::jthread> pool;
  for (std::size_t t = 0; t < threads; t++)
    pool.emplace_back([&, t] {
      for (std::size_t i = count * t / threads; i < count * (t + 1) / threads; i++) body(i);
    });
}

}  // namespace stokes
