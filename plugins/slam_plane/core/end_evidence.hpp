// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/gap.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Says which ends of observations are evidence of their walls' corners, and keeps account of what speaks against corners that are taken for known.
class EndEvidence {
 public:
  explicit EndEvidence(const Options& options) : noise_(options.noise()), map_bound_m_(options.map_bound_m) {}

  /// Sets `corner` for the ends of an observation that are evidence, and takes note in its wall of what contradicts.
  void judge(const OpenGaps& gaps, const Frame& frame, const AssociatedObservation& observation, WallMap& map,
             bool (&corner)[2]) const;

  /// Whether so much speaks against a corner that it is none.
  static bool is_disproved(const WallRecord& wall, int end);

 private:
  struct Against {
    bool beyond = false;  // more wall was seen than there is to it
    bool astray = false;  // the end is not where it was
  };
  /// What an end at a pose says against a corner that is known.
  Against compare(const WallEstimate& wall, const Vec2& place, int end, double slack) const;

  static void note_hidden(const Frame& frame, const AssociatedObservation& observation, WallRecord& wall);

  Noise noise_;
  double map_bound_m_;
};

}  // namespace hallway::slam_plane
