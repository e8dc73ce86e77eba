// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/convex2.hpp"

namespace hallway::sense {

/// The convex hull, without points that stand out of it by less than `tolerance_m`. O(n log n + n m).
Convex hull_of(std::vector<Vec2> points, double tolerance_m);

/// Takes from the pieces what `hole` covers. Pieces that it does not reach stay as they are.
void subtract(std::vector<Convex>& pieces, const Convex& hole);

}  // namespace hallway::sense
