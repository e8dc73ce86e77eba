// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_plane/core/frame_fit.hpp"
#include "slam_plane/core/sighting.hpp"

namespace hallway::slam_plane {

/// The iteration under way: what is seen, and from where.
struct Frame {
  std::uint64_t iteration = 0;  ///< how many frames there were, this one included
  std::vector<Sighting> sightings;
  Pose2 T_map_robot;
  Pose2 T_submap_robot;       ///< in the active submap
  PoseInformation in_map;     ///< what the map tells of the pose
  PoseInformation in_submap;  ///< what the active submap alone tells of it
};

/// Replaces the sightings by those of `pieces`, in their order, without the ones that cannot be of a wall: not finite, too far, too short, or
/// turning their back to the robot.
void take_pieces(std::span<const Piece> pieces, std::vector<Sighting>& sightings);

}  // namespace hallway::slam_plane
