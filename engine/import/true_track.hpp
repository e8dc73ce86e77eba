// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::import {

/// A true pose at a time.
struct TimedPose {
  std::int64_t t_ns = 0;  ///< not below 0
  Pose T_world_body;
};

/// True poses over time, which others have measured at times of their own.
class TrueTrack {
 public:
  /// @param poses      times increase
  /// @param within_ns  how far from a time asked for a pose may lie
  TrueTrack(std::vector<TimedPose> poses, std::int64_t within_ns);
  TrueTrack() = default;

  bool empty() const { return poses_.empty(); }
  /// The pose at a time: that of the time itself; else between the last one before and the first one after, in proportion to time, where both lie
  /// within the tolerance; else the one of them that does; else none. O(log n).
  std::optional<Pose> at(std::int64_t t_ns) const;

 private:
  std::vector<TimedPose> poses_;
  std::int64_t within_ns_ = 0;
};

}  // namespace hallway::import
