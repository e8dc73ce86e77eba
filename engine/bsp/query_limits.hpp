// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway::bsp {

/// Points of a query may lie this far from the world's origin, in metres along each axis.
inline constexpr double kMaxQueryCoordinate = 1e8;

/// Throws Error{kBadInput} if the point holds a NaN or lies beyond kMaxQueryCoordinate.
void check_query_point(const Vec3& point);

}  // namespace hallway::bsp
