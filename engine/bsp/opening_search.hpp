// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "bsp/empty_space.hpp"

namespace hallway::bsp {

/// A straight stretch of a way through one cell, metres.
struct WayPiece {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  std::int32_t cell = 0;
};

/// The hole by which a way leaves the inside: from the rim inwards, the first place where planes across the way have solid all around their
/// empty part, and from there the smallest such section before the way widens again. Slices of the tree do not matter, as sections run through
/// as many cells as there are between solids.
///
/// A hole that is in no plane, such as a gap all around below a roof, has no such section. Where the way outside of what was found passes
/// between two parallel faces that are closer than what was found is wide, Opening is that gap without polygons and with height 0. Where
/// nothing is found, width is 0 too.
/// @param way  from an occupant to the rim
Opening find_opening(const EmptySpace& space, const std::vector<WayPiece>& way);

}  // namespace hallway::bsp
