// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "peer.hpp"

namespace hallway::peers {

/// Finds planes one after the other among the points that are left. `next(rest)` gives the points of the next plane, a part of the
/// ascending list `rest`; none ends the search, and so do `patience` planes in a row that are too small.
template <typename Next>
std::vector<Members> peel(const Task& task, int patience, Next&& next) {
  std::vector<Members> planes;
  std::vector<std::uint32_t> rest(task.points.size());
  std::iota(rest.begin(), rest.end(), 0u);
  std::vector<bool> taken(rest.size(), false);
  const auto least = static_cast<std::size_t>(task.min_points);
  for (int misses = 0; rest.size() >= least && misses < patience;) {
    Members found = next(rest);
    if (found.empty()) break;
    for (const std::uint32_t i : found) taken[i] = true;
    std::erase_if(rest, [&](std::uint32_t i) { return taken[i]; });
    misses = found.size() < least ? misses + 1 : 0;
    if (misses == 0) planes.push_back(std::move(found));
  }
  return planes;
}

}  // namespace hallway::peers
