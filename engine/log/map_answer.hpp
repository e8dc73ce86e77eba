// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "log/id_pairs.hpp"
#include "log/map_landmarks.hpp"
#include "log/plane_landmarks.hpp"
#include "log/submap_poses.hpp"
#include "log/topology.hpp"

namespace hallway::log {

/// The map that a pipeline put in report().
struct MapAnswer {
  std::vector<MapLandmark> landmarks{};
  std::vector<PlaneLandmark> planes{};
  std::vector<SubmapPose> submaps{};
  std::vector<IdPair> submap_members{};  ///< submap, landmark or plane
  std::vector<IdPair>
      joined_epochs{};  ///< number of a part of the map, and that of the part that it was joined to
  std::optional<Topology> topology{};  ///< where the plugin put one
};

}  // namespace hallway::log
