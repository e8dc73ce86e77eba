// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "contact/floor_graph.hpp"

namespace hallway::contact {

/// Side of a cell of the floor, metres.
inline constexpr double kFloorCell = 0.5;
/// Storeys of a cell are at least this far apart, metres.
inline constexpr double kStorey = 0.3;
/// Passages narrower than twice this separate rooms, metres.
inline constexpr double kRoomClearance = 0.75;
/// Heights above the floor between which an obstacle bounds a room, metres: walls and cabinets do, desks and ledges do not.
inline constexpr double kRoomWallLow = 1.0;
inline constexpr double kRoomWallHigh = 1.5;
/// A core of a room has at least this area, square metres.
inline constexpr double kLeastRoom = 2.0;

/// Where a robot may be put down.
struct FreePlace {
  Vec3 position = Vec3::Zero();  ///< for Robot::put(), world frame, metres
  double yaw_rad = 0.0;
};

/// A room of a floor: the nodes that are nearer along the floor to its core than to that of another room. Its core is a connected part of
/// the floor that is at least kRoomClearance away from what bounds rooms.
struct FloorRoom {
  double area_m2 = 0.0;
  double core_area_m2 = 0.0;
  Vec3 centre = Vec3::Zero();  ///< mean of its nodes
};

/// The floor that a robot can reach from a start, and return from; explore_floor() says what that means. The same arguments give the same floor.
class ReachableFloor {
 public:
  /// The floor is empty where the robot does not stand at the start, or cannot move to a node next to it. O(n log n), n nodes, at most
  /// kMostFloorNodes. Throws as Robot and Robot::put() do.
  /// @param start     T_world_body; only its position and heading count
  /// @param is_solid  as Robot::put() has it
  ReachableFloor(const Obstacles& obstacles, const RobotSpec& spec, const Pose& start,
                 std::function<bool(const Vec3&)> is_solid = {});

  const std::vector<FloorNode>& nodes() const { return graph_.nodes; }
  /// True if there are more nodes than are looked at.
  bool is_cut_off() const { return graph_.is_cut_off; }
  /// Each node stands for a square of the lattice.
  double area_m2() const { return static_cast<double>(nodes().size()) * kFloorSpacing * kFloorSpacing; }

  /// Cells of kFloorCell with a node in them, several over each other where the nodes' heights have gaps of kStorey; by x, y and height.
  std::uint32_t n_cells() const { return static_cast<std::uint32_t>(cells_.size()); }
  /// The cell in which a robot is, if its origin is within kStorey / 2 of the heights of the cell's nodes. O(log n).
  std::optional<std::uint32_t> cell_at(const Vec3& body_origin) const;

  std::uint32_t n_rooms() const { return static_cast<std::uint32_t>(rooms_.size()); }
  /// By the least (ix, iy, z) of their cores.
  const std::vector<FloorRoom>& rooms() const { return rooms_; }
  /// The room that a robot has entered: in whose core its nearest node is. None in doorways and along walls. O(log n).
  std::optional<std::uint32_t> room_at(const Vec3& body_origin) const;
  /// The room that a node was given to; none on a floor without rooms.
  std::optional<std::uint32_t> room_of(std::uint32_t node) const;

  /// A place on the floor, uniform over the nodes, and a heading of those with which it can be reached, at which Robot::put() puts the robot and it stands. Other
  /// attempts give other places. None on an empty floor.
  std::optional<FreePlace> free_place(std::uint64_t seed, std::uint32_t attempt) const;

 private:
  struct Cell {
    std::int32_t cx = 0;
    std::int32_t cy = 0;
    double low = 0.0;
    double high = 0.0;
  };

  void make_cells();
  void make_rooms();
  std::optional<std::uint32_t> node_at(const Vec3& body_origin) const;

  const Obstacles& obstacles_;
  RobotSpec spec_;
  std::function<bool(const Vec3&)> is_solid_;
  FloorGraph graph_;
  std::vector<std::uint32_t> order_;  ///< nodes by (ix, iy, z)
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> room_;  ///< of each node
  std::vector<bool> is_core_;
  std::vector<FloorRoom> rooms_;
};

/// A start on the largest floor that was found.
struct FreeStart {
  FreePlace place;
  ReachableFloor floor;
};

/// Finds a start where none is known: up to 20 000 seeded places in a box, uniform; of those at which a robot stands the first 16. Each is on a floor.
/// The floor with most nodes is taken, the first of equal ones, and a free place on it. So a robot does not start on a cupboard or in a niche. None if the
/// robot stands nowhere, or moves nowhere.
std::optional<FreeStart> find_free_start(const Obstacles& obstacles, const RobotSpec& spec, const Box& bounds,
                                         const std::function<bool(const Vec3&)>& is_solid,
                                         std::uint64_t seed);

}  // namespace hallway::contact
