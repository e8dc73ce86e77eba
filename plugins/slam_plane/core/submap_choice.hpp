// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/frame.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// What is to become of the active submap.
struct SubmapChoice {
  bool change = false;
  bool lines_only = false;  ///< if it is changed: the frame does not determine its pose by itself
};

/// A frame goes into the active submap if that alone determines its pose, and else begins another one. `own`: what the frame's own lines and
/// corners tell.
SubmapChoice choose_submap(const WallMap& map, const Frame& frame, const PoseInformation& own,
                           const Options& options);

/// The closed submap whose first frame saw most nearly what this one sees; kNone if none overlaps it by Options::overlap.
Index old_submap(const WallMap& map, const Frame& frame, const Options& options);

}  // namespace hallway::slam_plane
