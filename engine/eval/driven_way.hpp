// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/planar_motion.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// A true pose of the way driven.
struct WayPose {
  std::int64_t t_ns = 0;
  PlanarPose pose{};   ///< world frame
  double way_m = 0.0;  ///< driven until then; what was driven backwards is subtracted

  Vec2 place() const { return {pose.x_m, pose.y_m}; }
  Vec2 forward() const;
  /// Unit, to the robot's right.
  Vec2 right() const;
  /// A point of the world in the body frame: forward, left.
  Vec2 body(const Vec2& point) const;
  /// A point of the body frame in the world.
  Vec2 world(const Vec2& point) const;
};

/// Where a pose is in the plane, and where its x axis points.
PlanarPose planar_part(const Pose& T_world_body);

/// The true poses of a robot on level ground, by time. Its memory grows with them.
class DrivenWay {
 public:
  /// Adds a pose; whole turns of its yaw do not matter. Throws Error{kInternal} for a time that is not after the one before.
  void add(std::int64_t t_ns, const PlanarPose& pose);

  const std::vector<WayPose>& poses() const { return poses_; }
  /// The pose at a time, between two poses by linear interpolation; empty before the first and after the last. O(log n).
  std::optional<WayPose> at(std::int64_t t_ns) const;

  /// How far the robot had driven each time that it came by a place as it did at time `t_ns`, in rising order, that time
  /// included: as far ahead in its body frame, on the same side, no more than `gate_m` farther from it, and within 75 degrees of the same
  /// heading. Empty where the pose at that time is not known. O(n).
  /// @param point  body frame at t_ns
  std::vector<double> passes(std::int64_t t_ns, const Vec2& point, double gate_m) const;

  /// How far the robot had driven when a point of the world was abreast of it: the first time after pose `from`, or before it if the robot was past
  /// the point there already. Where it was abreast at no time, how far it had driven at that pose.
  double way_abreast(const Vec2& point, std::size_t from) const;

 private:
  std::vector<WayPose> poses_;
};

}  // namespace hallway::eval
