// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "slam_plane/core/frame.hpp"

namespace hallway::slam_plane {

/// A time in which the robot's place along a direction could not be known. What was mapped since (epoch and later) hangs together, and so does
/// what was mapped before; how far they are displaced along the direction is known to `range_m` only.
struct Gap {
  std::uint32_t epoch = 0;        ///< of the walls and submaps that came after
  Vec2 direction = Vec2::Zero();  ///< unit, map frame
  double range_m = 0.0;           ///< bound of the displacement
  bool is_blind =
      false;  ///< no wall was known: what came after is tied to what was before by the prediction alone

  /// Too wide for walls from before it to be found where they are expected.
  bool is_wide() const { return range_m > kBridged_m; }
  static constexpr double kBridged_m = 0.1;
};

/// Poses answered in a part of the map belong to another part since the gap between them was closed.
struct JoinedPart {
  std::uint32_t part = 0;
  std::uint32_t into = 0;
};

/// The gaps that are open: opens one where nothing tells the place along a direction any more, widens it while that lasts, and closes it when
/// older walls are found where they are expected. Closing by a displacement is for GapSearch.
class OpenGaps {
 public:
  /// A gap's own range when it opens because no wall is known [frames of the fastest motion].
  static constexpr int kBridgeFrames = 10;

  /// Takes note of what the map tells of a frame. True when a gap opened. `motion`: of one frame; `fastest`: so far [m a frame].
  bool watch(const Frame& frame, const Pose2& motion, double fastest);

  /// Closes those since which there is none: older walls determine the frame where it was expected. `fit(epoch, T)` fits a pose to what
  /// is older than an epoch. Returns how many were closed.
  int close(const Frame& frame, const std::function<PoseInformation(std::uint32_t, Pose2&)>& fit);

  /// Takes out one that was bridged.
  void erase(const Gap& gap);

  bool empty() const { return gaps_.empty(); }
  const Gap& last() const { return gaps_.back(); }
  /// Oldest first.
  const std::vector<Gap>& all() const { return gaps_; }

  /// How many gaps there were: that of the walls and submaps that begin now.
  std::uint32_t epoch() const { return epoch_; }
  /// The oldest epoch whose walls are known to lie where the map has them, seen from here.
  std::uint32_t epochs_known() const;
  /// The part of the map that the robot is in: the epoch of the last blind gap that is open, or 0.
  std::uint32_t part() const;
  /// Parts begun after blind gaps that are closed now, ascending. O(blind gaps squared).
  std::vector<JoinedPart> joined_parts() const;
  /// The direction of the map in which the last frame was not tied to anything, or zero.
  Vec2 untied() const { return was_tied_ || gaps_.empty() ? Vec2::Zero() : gaps_.back().direction; }

 private:
  bool is_open(std::uint32_t epoch) const;

  std::vector<Gap> gaps_;
  std::vector<JoinedPart> parts_;  // begun after blind gaps, and the part that each came after
  std::uint32_t epoch_ = 0;
  bool was_tied_ = true;  // the last frame's place among the walls was determined
};

}  // namespace hallway::slam_plane
