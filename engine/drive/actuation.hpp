// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/random.hpp"
#include "drive/disturbance.hpp"
#include "drive/motion.hpp"
#include "drive/spec.hpp"
#include "drive/wheels.hpp"

namespace hallway::drive {

/// What the motors' motion becomes at a time.
struct Effect {
  PlanarTwist body{};  ///< true twist of the body
  PerWheel wheels{};   ///< speeds of the rims [m/s]
};

/// The effect at `part` of `whole` on the line between two.
Effect between(const Effect& from, const Effect& to, std::int64_t part, std::int64_t whole);

/// From the twist that is driven to the wheels and to the body: actuation noise, then slip.
///
/// The wheels turn by the driven twist with its noise. The body follows what the slipping wheels leave, loses the tracks' share of the turn, and drifts
/// sideways. Ackermann: the body stays on the circle of its steering, and both slips reduce the way on it; noise of the speed goes to the turn as well.
/// The five disturbances and the shares of turns have streams of random numbers of their own: none changes the draws of another.
class Actuation {
 public:
  /// The spec must be checked.
  Actuation(const DriveSpec& spec, std::uint64_t seed);

  /// The effect of a driven twist at a time, t_ns >= 0.
  Effect at(std::int64_t t_ns, const PlanarTwist& driven);

  /// The tracks lose another share from now on: one normal deviate, a function of the seed and of how often this was called.
  void begin_turn();

  /// Whether no disturbance changes with time.
  bool is_constant() const;

 private:
  PlanarTwist slipped(std::int64_t t_ns, const PlanarTwist& actuated, PerWheel speeds);

  DriveSpec spec_;
  Random turns_;
  std::uint64_t turn_ = 0;
  double turn_slip_;  // of the present turn
  DisturbanceProcess forward_noise_;
  DisturbanceProcess angular_noise_;
  DisturbanceProcess lateral_drift_;
  DisturbanceProcess left_slip_;
  DisturbanceProcess right_slip_;
};

}  // namespace hallway::drive
