// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "pvs/directed_portals.hpp"
#include "pvs/winding.hpp"

namespace hallway::pvs {

/// Planes that have one winding behind them and another one in front.
struct Separators {
  static constexpr std::size_t kCapacity = 2 * Winding::kCapacity;
  std::size_t count = 0;
  std::array<Cutter, kCapacity> planes{};  ///< those from `count` on mean nothing
};

/// How exactly points are known, and how far they can be from each other.
struct Precision {
  double noise = 0.0;
  double diameter = 0.0;
};

/// The planes through an edge of one winding and a vertex of the other one that have `behind` on their
/// negative side and `front` on their positive one: whatever a line from the first through the second reaches
/// after that lies in front of all of them. The windings are parts of the two portals. Teller, "Visibility
/// Computations in Densely Occluded Polyhedral Environments", 1992, chapter 5.
void separate(const Winding& behind, const DirectedPortal& behind_portal, const Winding& front,
              const DirectedPortal& front_portal, const Precision& precision, Separators& separators);

}  // namespace hallway::pvs
