// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/frame_fit.hpp"
#include "slam_plane/core/observation.hpp"

namespace hallway::slam_plane {

/// The iteration under way: what is seen, and from where.
struct Frame {
  std::uint64_t iteration = 0;  ///< how many frames there were, this one included
  std::vector<AssociatedObservation> observations;
  Pose2 T_map_robot;
  Pose2 T_submap_robot;       ///< in the active submap
  PoseInformation in_map;     ///< what the map tells of the pose
  PoseInformation in_submap;  ///< what the active submap alone tells of it
};

}  // namespace hallway::slam_plane
