// SPDX-License-Identifier: MIT
#pragma once

#include "planes/plane.hpp"

namespace hallway::planes {

/// The least distance between two rectangles (or other convex quadrilaterals, each in one plane), 0 where they meet. O(1).
double rectangle_distance(const Corners& a, const Corners& b);

}  // namespace hallway::planes
