// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::watch {

/// A line in the world, seen from above [m].
using Line = std::pair<Vec2, Vec2>;

/// What does not change while a run is watched; world frame, seen from above [m].
struct Scene {
  std::string name{};
  std::uint32_t iterations = 0;      ///< how many frames there will be; 0: not known
  std::vector<Line> plan{};          ///< what a level plane at the height of the sensors cuts from the map
  std::vector<Vec2> landmarks{};     ///< the true ones
  std::vector<Vec2> outline{};       ///< of the body, in its frame; empty where it is not known
  std::vector<Vec2> mapped{};        ///< the landmarks that a plugin mapped, at the end of the run
  std::vector<Line> mapped_walls{};  ///< the planes that it mapped, likewise

  /// What holds everything; empty where there is nothing.
  Eigen::AlignedBox2d bounds() const {
    Eigen::AlignedBox2d box;
    for (const Line& line : plan) box.extend(line.first).extend(line.second);
    for (const Vec2& place : landmarks) box.extend(place);
    return box;
  }
};

}  // namespace hallway::watch
