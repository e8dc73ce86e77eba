// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::foxglove {

/// The poses of a path that grows while a run goes on. They are shown anew whenever there are twice as many: all that is written of them is at most some three
/// times the path.
class PoseList {
 public:
  void add(const Pose& pose) { poses_.push_back(pose); }
  /// Whether there are twice as many as were shown last.
  bool is_due() const { return poses_.size() >= kFewest && poses_.size() >= 2 * shown_; }
  /// Whether there is anything that was not shown yet.
  bool has_news() const { return poses_.size() > shown_; }
  /// The poses so far.
  const std::vector<Pose>& show() {
    shown_ = poses_.size();
    return poses_;
  }

 private:
  static constexpr std::size_t kFewest = 16;

  std::vector<Pose> poses_;
  std::size_t shown_ = 0;
};

}  // namespace hallway::foxglove
