// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/map_step.hpp"

namespace hallway::slam_plane {

/// Places all submaps together, now and then, in slices: sooner after old ground was met.
class MapSolver {
 public:
  /// Takes note that a submap was closed; plan() may then begin a step.
  void note_closed() { ++closes_; }
  /// Takes note that ground was met again that had been out of view.
  void note_old_ground() { on_old_ground_ = true; }
  /// Takes note that a loop closed: the next plan() begins a step.
  void note_loop();

  /// Begins a step over all submaps if it is time.
  void plan(const WallMap& map);
  /// Goes on with a step that is under way. True if it came to its end and moved the map.
  bool advance(WallMap& map);
  /// Gives up the step that is under way: walls are not what they were.
  void abandon() { step_.abandon(); }

 private:
  MapStep step_;
  int closes_ = 0;  // of submaps since the last step
  bool on_old_ground_ = false;
};

/// The map after steps over all submaps, until they settle.
WallMap settled(WallMap map);

}  // namespace hallway::slam_plane
