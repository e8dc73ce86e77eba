// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "base/random.hpp"
#include "geometry/se3.hpp"

namespace hallway::sense {

/// A smooth way that never leaves the neighbourhood of where it began: along each axis two sine waves of random reach and
/// phase. A pure function of time.
class SmoothMotion {
 public:
  /// Draws a way from `random`, keyed by (step, index).
  /// @param speed_m_s  root mean square over all time; 0: stands
  SmoothMotion(const Random& random, std::uint32_t step, std::uint64_t index, double speed_m_s);

  /// How far it is from where it was at time 0, world axes, metres; along each axis at most kReach_m.
  Vec3 offset(double t_s) const;

  static constexpr double kReach_m = 3.0;

 private:
  struct Wave {
    double reach_m = 0.0;
    double rate = 0.0;   // radians per second
    double phase = 0.0;  // radians
    double start = 0.0;  // sine of the phase
  };
  static constexpr std::size_t kWavesPerAxis = 2;

  std::array<std::array<Wave, kWavesPerAxis>, 3> waves_;
};

}  // namespace hallway::sense
