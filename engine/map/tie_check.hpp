// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "map/document.hpp"
#include "map/world.hpp"

namespace hallway::map {

/// A brush that adds and one that takes away, at one place and with one `order`: which of them counts is decided by where they stand in the file, and editors
/// change that.
struct Tie {
  std::int64_t order = 0;
  const Solid* first = nullptr;   ///< in the file
  const Solid* second = nullptr;  ///< of the other kind
};

/// Of each `order` one tie, where there is any; the solids are the world's. O(n log n + pairs of brushes of one order whose boxes overlap along x), and gives up an order
/// after 1e8 pairs.
std::vector<Tie> tied_brushes(const Document& document, const World& world);

}  // namespace hallway::map
