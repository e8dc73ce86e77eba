// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "slam_plane/thesis/hints.hpp"
#include "slam_plane/thesis/locator.hpp"
#include "slam_plane/thesis/map_builder.hpp"
#include "slam_plane/thesis/motion_model.hpp"

namespace hallway::slam_plane::thesis {

inline constexpr SubmapIndex kNoSubmap = ~SubmapIndex{0};

/// A track that is not in the map yet (thesis 4.4.3.19).
struct Unassigned {
  TrackId track = 0;
  Iteration joined = -1;  ///< when it joined its last submap, which could not place it so far; -1: none
  std::optional<TrackId> part_of;  ///< it is another part of the wall of this track, which is seen too
};

/// An observation of now and the track that took it.
struct Match {
  std::size_t observation = 0;
  TrackId track = 0;
};

/// What an iteration leaves to the next one, but for what can be computed from observations (thesis 4.4.3.17).
struct Carried {
  std::vector<Unassigned> unassigned;
  SubmapIndex current = kNoSubmap;  ///< the current submap (Rule 22)
  MotionModel motion;
  bool located = false;       ///< the last iteration had a pose
  bool after_motion = false;  ///< a motion model was on and no old submap was met since (Rules 29, 37)
};

/// All that the steps of an iteration work on.
struct State {
  explicit State(const Options& options)
      : tracks(options.track()),
        pairs(options.compare()),
        map(options),
        locator(options),
        carried{{}, kNoSubmap, MotionModel(options.motion_after, options.motion_parallel_deg), false, false} {
  }

  Iteration now = -1;
  Iteration start = -1;  ///< iteration with the first observation; its robot frame is the map's
  TrackBook tracks;
  std::vector<Submap> submaps;
  std::size_t dropped_submaps = 0;  ///< of them, those that came to nothing and are empty
  StaticPairs pairs;
  MapBuilder map;
  Locator locator;
  Hints hints;
  Carried carried;

  std::vector<Match> matches;           ///< of this iteration
  std::vector<TrackId> seen;            ///< tracks of this iteration, ascending
  std::vector<TrackId> recent;          ///< tracks of the last few iterations, ascending
  std::vector<SubmapIndex> unanchored;  ///< in view, and only a pose can place them
  std::vector<TrackId> met_again;       ///< tracks that were found in the map in this iteration (Rule 11)
  std::vector<std::pair<SubmapIndex, int>>
      chart;  ///< how many seen tracks each submap has, ascending (Rule 22)
};

}  // namespace hallway::slam_plane::thesis
