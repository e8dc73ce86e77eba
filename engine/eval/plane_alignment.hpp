// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "geom/plane.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// A point of a map that lies on a plane of the world.
struct PointOnPlane {
  Vec3 point = Vec3::Zero();  ///< map frame
  Plane plane{};              ///< world
};

/// The motion T_world_map that lays points on their planes best, by least squares of their distances, from a start that is near it. Empty if the
/// planes leave a direction of it open. O(points).
std::optional<Pose> align_to_planes(std::span<const PointOnPlane> points, const Pose& start);

}  // namespace hallway::eval
