// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geom/plane_observation.hpp"

namespace hallway::planes {

/// Index of a point of a cloud.
using PointIndex = std::uint32_t;

/// Label of a point that belongs to no plane.
inline constexpr std::int64_t kNoLabel = -1;

/// A rectangle in space, counter-clockwise seen from where its plane's normal points.
using Corners = std::array<Vec3, 4>;

/// A plane that is known to be there.
struct TruePlane {
  std::int64_t label = 0;            ///< of its points
  Plane plane{};                     ///< either of the two normals
  std::optional<Corners> corners{};  ///< where its rectangle is known
};

/// What is known of a cloud.
struct Truth {
  std::vector<std::int64_t> labels{};  ///< of each point that of its plane, or kNoLabel
  std::vector<TruePlane> planes{};     ///< labels distinct; those without points are not asked for
  double noise = 0.0;                  ///< standard deviation of the points; 0 where not known
};

}  // namespace hallway::planes
