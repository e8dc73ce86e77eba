// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace hallway::log {

/// What returns of a lidar can be of.
struct SurfaceLabel {
  std::uint64_t id = 0;
  std::string thing{};     ///< a brush or a model, as messages name it; "robot": the robot itself
  std::string material{};  ///< as the map or the model names it; empty where it has none
  std::string mover{};     ///< what moves it; empty: nothing

  bool operator==(const SurfaceLabel&) const = default;
};

}  // namespace hallway::log
