// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"
#include "log/topology.hpp"

namespace hallway::foxglove {

/// Where a place of a topological map is, and where the robot was that saw it.
struct SeenPlace {
  Vec3 place = Vec3::Zero();
  Vec3 robot = Vec3::Zero();
};

/// The place of a node, which has none itself: only what the robot saw in its own frame, and when.
/// @param T_world_body  where the robot was at the node's time; the place is in the frame of that pose
inline SeenPlace seen_from(const log::TopologyNode& node, const Pose& T_world_body) {
  return {T_world_body * Vec3(node.x_m, node.y_m, 0.0), T_world_body.t};
}

/// The level unit vector along which the wall's step at a discontinuity goes: away from the robot where the wall goes on farther, to it where nearer. Zero at other
/// places.
inline Vec3 step_way(const log::TopologyNode& node, const SeenPlace& seen) {
  Vec3 way = seen.place - seen.robot;
  way.z() = 0.0;
  way = way.norm() > 0.0 ? Vec3(way.normalized()) : Vec3::UnitX();
  return node.direction * way;
}

}  // namespace hallway::foxglove
