// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hallway::eval {

/// What a robot that follows walls charts (thesis 2.2.4, figure 25).
enum class NodeKind : std::uint8_t {
  kDiscontinuity = 1,  ///< a step or an end of the followed wall
  kSweep = 2,          ///< a sonar sweep at an opening that is neither of the next two yet
  kRoom = 3,           ///< an opening to a room
  kHallwayEnd = 4,     ///< an opening to a hallway
  kJunction = 5,       ///< a place where hallways meet
};

/// A node of a charted topology. It has no pose: its place is relative to the robot at a time.
struct TopologyNode {
  std::uint32_t id = 0;  ///< unique
  NodeKind kind = NodeKind::kDiscontinuity;
  int direction = 0;  ///< of discontinuities: +1 the wall goes on farther from the robot, -1 nearer; else 0
  std::uint32_t visits = 1;
  /// Of discontinuities the step, +Inf where no wall was seen behind it; else NaN.
  double size_m = std::numeric_limits<double>::quiet_NaN();
  std::int64_t t_ns = 0;  ///< time of the frame in which the robot was abreast of it, the first time
  double x_m = 0.0;       ///< where it is in the robot's body frame at that time: forward, left
  double y_m = 0.0;
};

/// A way along the wall from one node to the next.
struct TopologyEdge {
  std::uint32_t from = 0;  ///< ids
  std::uint32_t to = 0;
  double length_m = 0.0;    ///< by odometry
  double confidence = 0.0;  ///< in [0, 1]
  int quarter_turns = 0;    ///< net turns of 90 degrees on the way, left positive
};

/// What a chart says of itself.
enum class LoopState : std::uint8_t {
  kOpen = 0,
  kClosed = 1,
  kUncertain = 2,  ///< it reads alike in several places
};

/// A topology as a plugin gives it.
struct Topology {
  std::vector<TopologyNode> nodes;
  std::vector<TopologyEdge> edges;
  LoopState loop = LoopState::kOpen;
  std::string note{};  ///< why `loop` is what it is
};

}  // namespace hallway::eval
