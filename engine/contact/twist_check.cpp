// SPDX-License-Identifier: MIT
#include "contact/twist_check.hpp"

#include <cmath>

#include "base/error.hpp"

namespace hallway::contact {

void check_twist(const PlanarTwist& twist) {
  // Written so that what is no number is refused too.
  if (std::abs(twist.forward_m_s) <= kGreatestSpeed && std::abs(twist.lateral_m_s) <= kGreatestSpeed &&
      std::abs(twist.angular_rad_s) <= kGreatestTurn)
    return;
  throw Error(ErrorCode::kBadInput, "a body's twist must be at most 100 m/s and 100 rad/s");
}

void check_ramp(const TwistRamp& ramp) {
  check_twist(ramp.from);
  check_twist(ramp.to);
  if (ramp.duration_ns < 1 || ramp.duration_ns > kGreatestDuration_ns)
    throw Error(ErrorCode::kBadInput, "a motion must last between 1 ns and an hour");
}

}  // namespace hallway::contact
