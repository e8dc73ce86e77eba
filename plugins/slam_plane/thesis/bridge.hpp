// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// Where the robot is while iterations are done again (Rule 33): the planes that were seen last are followed on the map as it was before time was rolled back. Nothing is learned; what comes into view is
/// followed too, so that it is not taken for a wall beside it that went out of view, and is looked for in that map (Rule 11).
class Bridge {
 public:
  /// What is reported of one frame.
  struct Report {
    std::optional<Alignment> location;
    std::vector<LandmarkId> associations;  ///< of each observation
    bool seen = false;                     ///< there was an observation
  };

  /// From the state after an iteration, before it is rolled back. O(planes of the map).
  Bridge(const Options& options, const State& before);

  /// Takes the next frame. O(observations * planes that are followed + new observations * planes about the robot).
  Report follow(std::span<const WallObservation> given);

 private:
  struct Followed {
    PlaneTrack track;  // its newest observations
    Reference
        seen;  // in the robot's frame, with the ends that stood still; not valid if the map does not have it
    Reference in_map;
    LandmarkId wall = kNoLandmark;
  };

  /// A plane of the map as it was.
  struct Mapped {
    Reference place;
    LandmarkId wall;
  };

  Followed& followed(const PlaneTrack& track);
  void begin_following(const TimedObservation& observation, std::span<const LandmarkId> taken);
  void forget_unseen();
  std::vector<PlanePair> evidence_of(std::span<Followed* const> mapped) const;

  MatchOptions options_;
  TrackOptions memory_;    // no more than tracks are matched by
  double corner_bound_m_;  // from where an end should be, along its wall
  Iteration now_;
  MotionModel motion_;
  std::vector<Followed> followed_;  // by the track's id, ascending
  TrackId next_ = 0;
  std::vector<Mapped> about_;  // the robot when it began
  MatchOptions in_map_;        // what an observation may differ by from one of them
};

}  // namespace hallway::slam_plane::thesis
