// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hallway::eval {

/// A pair that an assignment may have.
struct CandidatePair {
  std::size_t left = 0;
  std::size_t right = 0;
  double cost = 0.0;  ///< at least 0
};

/// A one-to-one assignment: by left item its right one. It has as many pairs as possible and, among those assignments, the least sum of costs. Found by
/// shortest augmenting paths (Bellman-Ford). O(pairs * items * candidates) at worst.
/// @param lefts, rights  how many items there are; the candidates' are below
std::vector<std::optional<std::size_t>> assign(std::size_t lefts, std::size_t rights,
                                               const std::vector<CandidatePair>& candidates);

}  // namespace hallway::eval
