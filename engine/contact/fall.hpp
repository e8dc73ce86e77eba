// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "contact/mover.hpp"

namespace hallway::contact {

/// How deep below the body a floor is looked for, metres.
inline constexpr double kDeepestFall = 1000.0;

/// How a body goes down over a ledge.
struct Fall {
  std::vector<Pose>
      poses{};            ///< over the ledge, then on the floor below; empty if it cannot get over the ledge
  double height_m = 0.0;  ///< from the pose that it falls from to where it stands
  bool is_lost = false;   ///< there is no floor below that it could stand on
};

/// Lets a body fall that drives over a ledge: it goes level along its way until it is past the ledge, then straight down to the floor below,
/// where it stands as Ground::settle() has it. Both ways are proved to be free of obstacles; the shortest level way for which that is so is taken, in steps
/// of kLongestPart, of up to the body's diameter.
/// @param pose  where the body stands
/// @param way   direction over the ledge, level; any length
Fall fall_over(const BodyShape& shape, const Ground& ground, SweepCheck& check, const Pose& pose,
               const Vec3& way);

/// The pose on the floor below a guess: where a robot is put down. None if there is no floor within `depth` below, or none to stand on.
std::optional<Stance> stance_below(const Ground& ground, const Pose& guess, double depth);

}  // namespace hallway::contact
