// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wall_follower/core/odometer.hpp"

namespace hallway::wall_follower {

inline constexpr int kWholeTurn = 4;  ///< turns of 90 degrees

/// What a landmark is. Numbers from 1 on are those of topologies in the plugin ABI.
enum class Kind : std::uint8_t {
  corner = 0,         ///< a wall ahead, along which the way turns left: a landmark, but no node of a topology
  discontinuity = 1,  ///< a step or an end of the followed wall
  sweep = 2,          ///< an opening that is neither a room nor a hallway, by its sweep
  room = 3,
  hallway_end = 4,  ///< where a hallway ends
  junction = 5      ///< an opening that leads on
};

/// A landmark at the wall.
struct Node {
  std::uint32_t id = 0;
  Kind kind = Kind::discontinuity;
  int direction = 0;  ///< of discontinuities: +1 the wall goes on farther from the robot, -1 nearer
  std::uint32_t visits = 1;
  double size_m = 0.0;       ///< of discontinuities: infinite where no wall was seen behind; NaN of others
  std::int64_t t_ns = 0;     ///< of the frame in which the robot was abreast of it, the first time
  Vec2 body = Vec2::Zero();  ///< where it is in the body frame at that time [m]
  Vec2 at = Vec2::Zero();    ///< where it is by the reckoned way, with turns of 90 degrees [m]
  double way_m = 0.0;        ///< along the wall since the start, by odometry
  bool is_hidden = false;    ///< a landmark that is no node of a topology: of something dark
  int quarter = 0;           ///< direction of the wall before it, in turns of 90 degrees since the start
};

/// The way from a node to the next one along the wall, or from an opening across to another wall.
struct Edge {
  std::uint32_t from = 0, to = 0;  ///< ids
  double length_m = 0.0;
  double confidence = 1.0;  ///< from 0 to 1: less where the robot touched something or saw no wall
  int quarter_turns = 0;    ///< net turns of 90 degrees on the way, left positive
  bool is_crossing = false;
};

/// Whether the wall that was followed is known to lead back to its beginning.
enum class Loop : std::uint8_t {
  open = 0,
  closed = 1,
  uncertain = 2  ///< it reads alike in several places
};

/// A wall that leads back to its beginning: its landmarks in the order in which the robot comes along.
struct Circuit {
  std::vector<std::uint32_t> lap;  ///< ids
  double begin_m = 0.0;            ///< Node::way_m of the first one
  double length_m = 0.0;           ///< of a lap
};

/// The topological map (thesis figure 25): landmarks in the order in which the robot came along, wall by wall. It has no pose.
struct Chart {
  std::vector<Node> nodes;  ///< by ids
  std::vector<Edge> edges;
  std::vector<Circuit> circuits;  ///< walls that are closed
  std::vector<std::vector<std::uint32_t>>
      leads;  ///< ids of landmarks that were met before a circuit, closed or known, and are not of it
  std::size_t wall_begin =
      0;  ///< index of the first landmark of the wall that is followed, if that is not known yet
  Loop loop = Loop::open;
  std::string note;
  std::uint32_t changes = 0;  ///< how often its landmarks or ways changed

  /// Adds a landmark of the wall that is followed. @param confidence  of the way to it
  void add(Node node, double confidence);
  /// The landmarks of the wall that is followed.
  std::span<const Node> wall() const { return std::span(nodes).subspan(wall_begin); }
  /// A landmark that the chart has. O(log nodes).
  Node& node(std::uint32_t id);
  const Node& node(std::uint32_t id) const;
  /// Whether it has the landmark.
  bool has(std::uint32_t id) const;
  /// Leaves landmarks out, with the edges from and to them. Those of circuits must not be among them.
  void remove(const std::vector<std::uint32_t>& ids);

 private:
  std::uint32_t next_id_ = 0;
};

}  // namespace hallway::wall_follower
