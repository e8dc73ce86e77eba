// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "drive/motion.hpp"
#include "drive/polyline.hpp"
#include "drive/spec.hpp"
#include "geometry/se3.hpp"

namespace hallway::drive {

/// How a path is followed.
struct FollowerSettings {
  double look_ahead_m = 0.5;  ///< arc length from the robot's place on the path to the point that it aims at
  double speed_m_s = 0.3;     ///< wanted; the drive's limits and bends reduce it
  double period_s = 0.1;      ///< between two commands; of use to the stop at the end
  double lost_look_aheads = 3.0;  ///< farther from the path than so many look-aheads, the robot is lost
  bool closed = false;            ///< from the last point to the first one again, without end
};

/// What a follower makes of a pose.
struct FollowStep {
  Command command{};
  bool lost = false;        ///< too far from the path; the command is zero
  bool done = false;        ///< within 1 cm of an open path's end, along it; the command stays zero
  double along_m = 0.0;     ///< progress since the begin of the path; of a closed one over all rounds
  double distance_m = 0.0;  ///< from the path
};

/// Follows a path by pure pursuit (Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm", CMU-RI-TR-92-01): drives on the arc that leads from
/// the robot to a point of the path one look-ahead before it. A value: a copy goes on as the original does.
///
/// The progress never shrinks, and a step adds at most one look-ahead: at a crossing the robot stays on its branch. The speed falls where a bend would
/// need more than the limits of turn or wheels, and towards the end of an open path as half the deceleration allows. A drive that turns on the spot does so
/// for a point behind it; a car drives its narrowest circle. The known share of a turn that tracks lose is commanded on top. An omnidirectional robot looks
/// along its path.
class Follower {
 public:
  /// @param points  the path in the world, in metres; x and y count. It is followed as a polyline: so points should be dense
  /// Throws Error{kBadInput} for a path without two different finite points, for settings out of range, and for a spec that check() refuses.
  Follower(const std::vector<Vec3>& points, const DriveSpec& spec, const FollowerSettings& settings);

  /// The next command, for a robot at a pose in the world. The robot must be upright enough that its x axis is not vertical.
  FollowStep next(const Pose& T_world_body);

  double length_m() const { return path_.length_m(); }

 private:
  double remaining_m() const { return path_.length_m() - along_m_; }
  double wanted_speed() const;
  double driven_speed(double wanted, double curvature) const;
  Command pursue(const Vec2& aim) const;

  Polyline path_;
  DriveSpec spec_;
  FollowerSettings settings_;
  double along_m_ = 0.0;
  bool done_ = false;
};

}  // namespace hallway::drive
