// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/convex2.hpp"

namespace hallway::sense {

/// The convex hull, without points that stand out of it by less than `tolerance_m`. Fewer than three points that differ: nothing. O(n log n + n m).
///
/// Not convex_hull(): that one measures turns from the corner before the last, this one from the last. Rounding then decides otherwise which of two corners
/// that nearly coincide stays, and the last digits of what a face sensor gives rest on it.
Convex hull_of(std::vector<Vec2> points, double tolerance_m);

/// Takes from the pieces what `hole` covers. Pieces that it does not reach stay as they are.
void subtract(std::vector<Convex>& pieces, const Convex& hole);

}  // namespace hallway::sense
