// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "contact/reachable_floor.hpp"
#include "contact/robot.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "sim/models.hpp"
#include "sim/scenario.hpp"
#include "world/compiled_world.hpp"

namespace hallway::sim {

/// What the body of a robot with a drive can meet in a world, and where the robot begins.
class DrivenWorld {
 public:
  /// Keeps a reference to the world. O(n log n) in its triangles.
  /// Throws Error{kBadInput} for a robot without a body or with one that cannot stand on its wheels, and for a start, or a place that it is carried to, at which
  /// it does not stand or which the map does not have.
  /// @param scenario  of a robot with a drive
  DrivenWorld(const Scenario& scenario, const map::Document& document, const world::CompiledWorld& world,
              const PlacedModels& models);
  DrivenWorld(const DrivenWorld&) = delete;
  DrivenWorld& operator=(const DrivenWorld&) = delete;

  const contact::Obstacles& obstacles() const { return obstacles_; }
  /// In the frame of contact::BodyShape: the origin is on the floor.
  const contact::RobotSpec& robot() const { return robot_; }
  /// The body's frame, as scenarios have it, in the frame on the floor: a shift along z.
  const Pose& T_floor_body() const { return T_floor_body_; }
  /// Where the robot begins, T_world_body.
  const Pose& start() const { return start_; }
  /// The floor that the robot can reach from there; found when it is first asked for. Not for several threads at once.
  const contact::ReachableFloor& floor() const;
  /// Puts a robot there, at time 0.
  void put_at_start(contact::Robot& robot) const;
  /// Carries a robot to the place of a kidnap of the scenario, by the event's index, at the present time.
  void carry(contact::Robot& robot, std::size_t event) const;

 private:
  bool is_solid(const Vec3& point) const;
  contact::Start put(contact::Robot& robot, const Pose& T_world_body) const;
  void find_start(const Scenario& scenario, const map::Document& document);
  void find_kidnaps(const Scenario& scenario, const map::Document& document);

  const world::CompiledWorld& world_;
  contact::Obstacles obstacles_;
  contact::RobotSpec robot_;
  Pose T_floor_body_;
  Pose place_;  ///< given to put(): the start before the robot has come down to its floor
  Pose start_;
  std::vector<Pose> kidnaps_;  ///< by event: given to carry()
  mutable std::optional<contact::ReachableFloor> floor_;
};

}  // namespace hallway::sim
