// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "slam_plane/thesis/interval.hpp"

namespace hallway::slam_plane::thesis {

/// What a plane's visible part does.
enum class Trend : unsigned char { steady, growing, shrinking };

/// Notices when a plane turns from growing to shrinking, or back (Rule 18): a moving average of its length has to fall below its highest value, or rise above
/// its lowest, by the hysteresis. A value, so that a roll back can put back an old one.
class TrendDetector {
 public:
  /// Takes the newest observation. `average` [m]: of its length and those before it in the window, less the longest and the shortest one; `peak` and `dip`: iterations of the longest and
  /// of the shortest observation in the window, the latest of equal ones.
  ///
  /// @returns the last iteration of the phase that ended, if the plane is found to have turned.
  std::optional<Iteration> add(double average, Iteration peak, Iteration dip, double hysteresis);

  /// What it does in the current phase: steady until it is seen to grow or to shrink.
  Trend trend() const { return trend_; }

 private:
  Trend trend_ = Trend::steady;
  bool empty_ = true;
  double highest_ = 0.0;  // average in this phase
  double lowest_ = 0.0;
  Iteration peak_ = 0;
  Iteration dip_ = 0;
};

}  // namespace hallway::slam_plane::thesis
