// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace hallway::sim {

/// The way of a robot that begins at rest, drives at a speed and ends at rest, with an acceleration that never jumps, nor does its slope. While it
/// gains speed, its speed at the part u of the ramp's time is V (6 u^5 - 15 u^4 + 10 u^3); while it loses speed, the same backwards.
class SmoothPace {
 public:
  /// Greatest acceleration of a ramp.
  static constexpr double kAcceleration_m_s2 = 1.0;

  /// @param speed_m_s  between the ramps, from 0; less where the way is too short for both ramps
  /// @param end_m      where it comes to rest, from 0; infinite: it goes on
  SmoothPace(double speed_m_s, double end_m = std::numeric_limits<double>::infinity());

  struct State {
    double way_m = 0.0;
    double speed_m_s = 0.0;
    double acceleration_m_s2 = 0.0;
  };
  /// @param t_s  before 0 it rests at its begin
  State at(double t_s) const;
  /// The first time at which a way has been made. @param way_m  from 0 to what is reached
  double time_of(double way_m) const;
  /// When ramps begin and end, ascending; those that there are.
  std::vector<double> joints_s() const;

 private:
  double speed_m_s_;
  double end_m_;
  double ramp_s_;    ///< of one ramp
  double cruise_s_;  ///< between them; infinite: without an end
};

}  // namespace hallway::sim
