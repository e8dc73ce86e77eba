// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "contact/twist_check.hpp"

namespace hallway::contact {

/// A half space of twists, in the body's frame: x * forward_m_s + y * lateral_m_s + turn * angular_rad_s >= least.
struct TwistLimit {
  double x = 0.0;
  double y = 0.0;
  double turn = 0.0;   ///< metres
  double least = 0.0;  ///< metres per second

  /// How fast a twist moves away: the left side of the inequality.
  double speed(const PlanarTwist& twist) const {
    return x * twist.forward_m_s + y * twist.lateral_m_s + turn * twist.angular_rad_s;
  }
};

/// More limits than this are not looked at.
inline constexpr std::size_t kMostLimits = 24;

/// The limit that keeps a point of a body from moving against a normal: normal . (v + w x r) >= least.
/// @param pose    T_world_body
/// @param point   of the body, world frame
/// @param normal  unit, world frame, from the obstacle to the body
TwistLimit limit_at(const Pose& pose, const Vec3& point, const Vec3& normal, double least);

/// The twist within all limits that is nearest to the wanted one: the motion of a body that slides without friction, by Gauss's principle of least
/// constraint for a body whose radius of gyration is `gyration`. It is unique. None if no twist is within the limits; 0 is where no `least` is
/// positive. Where every `least` is 0, the twist is not longer than the wanted one and does not turn back against it.
///
/// All sets of up to three limits that hold with equality are tried in order: O(n^4) at worst, n limits, a few in practice.
/// @param gyration  metres, positive: turns count as speeds at this radius
std::optional<PlanarTwist> nearest_twist(const PlanarTwist& wanted, const std::vector<TwistLimit>& limits,
                                         double gyration);

/// The longest share of the wanted twist, from 0 to 1, that is within the limits: the motion of a body that stops.
/// None if not even standing is.
std::optional<PlanarTwist> shortened_twist(const PlanarTwist& wanted, const std::vector<TwistLimit>& limits);

}  // namespace hallway::contact
