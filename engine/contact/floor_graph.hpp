// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/robot.hpp"

namespace hallway::contact {

/// Distance of the lattice's nodes along x and y, metres. They are at (i + 1/2) times it: a square of 0.5 m has 16 of them.
inline constexpr double kFloorSpacing = 0.125;
/// No more nodes than this are looked at.
inline constexpr std::size_t kMostFloorNodes = 4'000'000;
inline constexpr std::uint32_t kNoFloorNode = std::numeric_limits<std::uint32_t>::max();

/// A place of the lattice at which a robot can stand.
struct FloorNode {
  std::int32_t ix = 0;
  std::int32_t iy = 0;
  double z = 0.0;             ///< of the body's origin, metres
  Vec2 slope = Vec2::Zero();  ///< how the plane of its wheels rises along x and y
  std::uint8_t headings = 0;  ///< bit k: it can be reached with the heading k * 45 degrees
  std::array<std::uint32_t, 8> next{kNoFloorNode, kNoFloorNode, kNoFloorNode, kNoFloorNode, kNoFloorNode,
                                    kNoFloorNode, kNoFloorNode, kNoFloorNode};  ///< towards k * 45 degrees

  Vec3 at() const { return {(ix + 0.5) * kFloorSpacing, (iy + 0.5) * kFloorSpacing, z}; }
};

/// The unit vector of a heading, 0 to 7.
Vec2 heading_vector(int heading);
/// A stance at a node with a heading, T_world_body.
Pose pose_on(const FloorNode& node, int heading);

/// The nodes that a robot can reach, in the order in which they were found.
struct FloorGraph {
  std::vector<FloorNode> nodes;
  bool is_cut_off = false;  ///< kMostFloorNodes were found
};

/// Searches the floor from a stance, breadth first.
///
/// The robot goes straight ahead or back to one of eight neighbours, and turns on the spot by 45 degrees; whatever drive it has. A motion counts
/// if it can be driven in both directions. Where the floor is flat, the body is an upright prism or a cylinder about its
/// origin, 1 mm larger than it is; elsewhere TrialDrive drives it. Falls do not count.
/// The start is joined to the nodes next to it: by turning, going straight and turning, or by going straight with its heading.
FloorGraph explore_floor(const Obstacles& obstacles, const RobotSpec& spec, const Pose& start);

}  // namespace hallway::contact
