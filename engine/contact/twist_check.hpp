// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geometry/planar_motion.hpp"

namespace hallway::contact {

/// Greatest parts of a twist that are accepted: metres per second and radians per second.
inline constexpr double kGreatestSpeed = 100.0;
inline constexpr double kGreatestTurn = 100.0;
/// Longest ramp that is accepted: an hour.
inline constexpr std::int64_t kGreatestDuration_ns = 3'600'000'000'000;

/// Throws Error{kBadInput} for a twist with a part that is no number or beyond the greatest.
void check_twist(const PlanarTwist& twist);
/// The same for both ends of a ramp, and for a duration that is not in [1, kGreatestDuration_ns].
void check_ramp(const TwistRamp& ramp);

}  // namespace hallway::contact
