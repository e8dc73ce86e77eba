// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Says which wall each observation of a frame is, by where it lies. An observation is a wall's when directions agree, its middle lies near the
/// wall's line, and the two overlap by at least half of the shorter one; mere neighbours on one line are two walls.
class FrameMatcher {
 public:
  explicit FrameMatcher(const Options& options);

  /// Turns the pose by the median angle between observations and what of `recent` they may be. O(observations * recent).
  void correct_heading(const WallMap& map, const std::vector<Index>& recent,
                       const std::vector<AssociatedObservation>& frame, Pose2& T_map_robot);

  /// Gives walls seen just before to the observations that have none, by where the walls are, or else, as outliers, by where they were seen a few
  /// iterations ago. Sets Observation::outlier.
  void match_recent(const WallMap& map, const std::vector<Index>& recent, std::uint64_t iteration,
                    const Pose2& T_map_robot, std::vector<AssociatedObservation>& frame);

  /// Gives any walls to the observations that have none, but those of an epoch before `since`, and none whose corners
  /// contradict. O(observations), flat in the size of the map.
  void match_map(const WallMap& map, std::uint32_t since, const Pose2& T_map_robot,
                 std::vector<AssociatedObservation>& frame);

 private:
  /// How well a segment of the map's frame fits a wall, 0 for not at all.
  double score(const WallEstimate& wall, const Vec2& a, const Vec2& b, const Vec2& direction,
               double bound) const;
  bool contradicts(const WallEstimate& wall, const AssociatedObservation& observation,
                   const Vec2 (&end)[2]) const;
  void resolve_rivals(const WallMap& map, const Pose2& T_map_robot,
                      std::vector<AssociatedObservation>& frame);

  double near_bound_;
  double map_bound_;
  double angle_;
  double sine_;
  std::vector<double> turns_;
  std::vector<double> scores_;    // of the frame's matches
  std::vector<Index> displaced_;  // walls that were not seen where they are
};

}  // namespace hallway::slam_plane
