// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::foxglove {

/// Where a body was, by time: 64 bytes for each pose.
class PoseHistory {
 public:
  /// Times do not decrease.
  void add(std::int64_t t_ns, const Pose& pose) { poses_.emplace_back(t_ns, pose); }
  bool empty() const { return poses_.empty(); }
  /// The last pose that is not after a time; null where there is none. O(log n).
  const Pose* at(std::int64_t t_ns) const {
    const auto later = std::ranges::upper_bound(poses_, t_ns, {}, &std::pair<std::int64_t, Pose>::first);
    return later == poses_.begin() ? nullptr : &std::prev(later)->second;
  }

 private:
  std::vector<std::pair<std::int64_t, Pose>> poses_;
};

}  // namespace hallway::foxglove
