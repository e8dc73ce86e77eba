// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/map_step.hpp"

namespace hallway::slam_plane {

/// Keeps the submaps where they agree best: again and again those about the active one are placed together, and all of them when ground was met
/// again that had been out of view. In slices, so that what a frame costs is flat in the size of the map.
class MapSolver {
 public:
  /// Takes note that a submap was closed: a step places those about it.
  void note_closed() {
    has_closed_ = true;
    ++closes_since_whole_;
  }
  /// Takes note that ground was met again that had been out of view.
  void note_old_ground() { on_old_ground_ = true; }
  /// Takes note that submaps were moved to close a loop: walls are refreshed, those about the active submap at once, and the next plan() begins a step
  /// over all submaps, in larger slices.
  void note_loop(WallMap& map);

  /// Begins a step if it is time; to be asked each frame. The active submap began where a single frame was: it is placed anew, with those next to it,
  /// each time that it has twice as many frames.
  void plan(const WallMap& map);
  /// Goes on with what is under way. True if a step came to its end and moved the map.
  bool advance(WallMap& map);
  /// Gives up the step that is under way, for it to begin anew: walls are not what they were.
  void abandon() {
    has_closed_ = has_closed_ || step_.under_way();
    step_.abandon();
  }

  /// The map with all walls refreshed. O(map).
  WallMap refreshed(WallMap map) const;

 private:
  void refresh(WallMap& map, double work);

  MapStep step_;
  std::vector<Index> stale_;  // walls that are to be refreshed, nearest first
  std::size_t next_stale_ = 0;
  bool has_closed_ = false;     // a submap, since the last step
  bool is_active_due_ = false;  // a step of the active one
  int closes_since_whole_ = 0;  // since the last one over all
  bool on_old_ground_ = false;
  bool is_whole_ = false;  // the step under way is one over all submaps
  bool is_urgent_ = false;
};

/// The map after steps over all submaps, until they converge.
WallMap optimised(WallMap map);

}  // namespace hallway::slam_plane
