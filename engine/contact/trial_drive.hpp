// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "contact/robot.hpp"

namespace hallway::contact {

/// Drives a body as Robot does where nothing is in its way: in parts of at most kLongestPart or kGreatestPartTurn, each of which ends in a
/// stance and is proved to be free. The first part that is not, ends the trial.
class TrialDrive {
 public:
  /// Keeps a reference to the obstacles. Throws as Robot does.
  TrialDrive(const Obstacles& obstacles, const RobotSpec& spec);
  TrialDrive(const TrialDrive&) = delete;
  TrialDrive& operator=(const TrialDrive&) = delete;

  /// The stance at a pose near the floor, if there is one at which the body is free.
  std::optional<Pose> stand(const Pose& guess);
  /// Goes straight to another x and y; the heading stays. The pose there, or none.
  std::optional<Pose> go(const Pose& from, const Vec2& to);
  /// Turns on the spot by an angle, radians.
  std::optional<Pose> turn(const Pose& from, double angle);

 private:
  std::optional<Pose> part(const Pose& from, const PlanarTwist& twist);

  const BodyShape shape_;
  Ground ground_;
  SweepCheck check_;
};

}  // namespace hallway::contact
