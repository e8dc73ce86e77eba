// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam_plane/thesis/map_builder.hpp"
#include "slam_plane/thesis/submap.hpp"

namespace hallway::slam_plane::thesis {

/// Finds out which ends of what is seen now are static, and from them and the map where the robot is (thesis 4.5 GetPoset; Rules 5, 16, 19).
class Locator {
 public:
  explicit Locator(const Options& options) : options_(options) {}

  /// Notes which ends the comparisons of a submap found static on an interval that lasts until now. O(members).
  void note(const Submap& submap, Iteration now);

  /// Notes the same of one track.
  void note(TrackId track, const bool (&ends)[2], Iteration now);

  /// An observation of now, in the robot's frame, with the ends that are known to be static.
  Reference seen(const PlaneTrack& track, Iteration now) const;

  /// The robot's pose from the tracks that are seen now. An end that no submap tells of is looked for in comparisons with the others
  /// (Rule 19). `guess` tells what they leave open. Nothing if none is in the map.
  std::optional<Alignment> locate(std::span<const TrackId> tracks_now, const TrackBook& tracks,
                                  const MapBuilder& map, StaticPairs& pairs, Iteration now,
                                  const Pose2& guess);

  void clear() { static_.clear(); }

 private:
  struct StaticEnds {
    Iteration at = -1;
    bool end[2] = {false, false};
  };

  void recalculate(TrackId id, std::span<const TrackId> tracks_now, const TrackBook& tracks,
                   StaticPairs& pairs, Iteration now);

  Options options_;
  std::vector<StaticEnds> static_;  // by track
};

}  // namespace hallway::slam_plane::thesis
