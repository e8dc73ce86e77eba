// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Poses of submaps as matrices, for many points of few submaps: each is made when it is first asked for, and buffers are kept, so that what
/// a round costs grows with the submaps asked for and not with the map.
class PoseMotions {
 public:
  /// Begins a round in which nothing is known. `submaps`: how many there are. O(submaps new since the last round).
  void begin(std::size_t submaps) {
    ++round_;
    if (submaps > known_.size()) known_.resize(submaps);
  }
  /// Whether a submap's motion is known in this round.
  bool has(std::uint32_t submap) const { return known_[submap].round == round_; }
  void set(std::uint32_t submap, const Pose& pose) { known_[submap] = {PointMotion(pose), round_}; }
  /// The motion of a submap, by `poses` where it is not known yet.
  const PointMotion& of(std::uint32_t submap, const std::vector<Pose>& poses) {
    if (!has(submap)) set(submap, poses[submap]);
    return known_[submap].motion;
  }

 private:
  struct Known {
    PointMotion motion{Pose{}};
    std::uint64_t round = 0;
  };

  std::vector<Known> known_;  // by submap
  std::uint64_t round_ = 0;
};

}  // namespace hallway::slam_point
