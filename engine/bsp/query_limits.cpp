// SPDX-License-Identifier: MIT
#include "bsp/query_limits.hpp"

#include "base/error.hpp"

namespace hallway::bsp {

void check_query_point(const Vec3& point) {
  // Written so that a NaN fails.
  if (point.cwiseAbs().x() <= kMaxQueryCoordinate && point.cwiseAbs().y() <= kMaxQueryCoordinate &&
      point.cwiseAbs().z() <= kMaxQueryCoordinate)
    return;
  throw Error(ErrorCode::kBadInput, "a point of a query is not finite or lies beyond 1e8 m of the origin");
}

}  // namespace hallway::bsp
