// SPDX-License-Identifier: MIT
#include "wall_follower/core/senses.hpp"

#include <cmath>

namespace hallway::wall_follower {

Vec2 Mount::point(double range_m) const {
  return place + range_m * Vec2(std::cos(direction), std::sin(direction));
}

}  // namespace hallway::wall_follower
