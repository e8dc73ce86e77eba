// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_map.hpp"

#include <utility>

namespace hallway::slam_plane {
namespace {

WallLandmark reported(LandmarkId id, const WallRecord& record, std::uint32_t min_observations) {
  const WallEstimate& estimate = record.estimate;
  WallLandmark wall;
  wall.id = id;
  wall.a = estimate.extent(kEndA);
  wall.b = estimate.extent(kEndB);
  for (int k = 0; k < 2; ++k) wall.certain[k] = estimate.known[k];
  wall.z_low = record.z_low;
  wall.z_high = record.z_high;
  wall.observations = record.count;
  if (record.is_dynamic) {
    wall.status = LandmarkStatus::dynamic;
  } else if (record.count >= min_observations) {
    wall.status = LandmarkStatus::mapped;
  }
  return wall;
}

}  // namespace

Map report_map(const WallMap& walls, int min_observations) {
  Map map;
  for (Index w = 0; w < walls.walls.size(); ++w) {
    const WallRecord& record = walls.walls[w];
    if (record.merged_into != kNone || (record.memberships.empty() && !record.is_dynamic)) continue;
    map.walls.push_back(reported(w, record, static_cast<std::uint32_t>(min_observations)));
  }
  for (Index s = 0; s < walls.submaps.size(); ++s) {
    Submap submap;
    submap.id = s;
    submap.T_map_submap = walls.submaps[s].T_map_submap;
    submap.lines_only = walls.submaps[s].lines_only;
    for (const Member& member : walls.submaps[s].members) {
      if (member.wall != kNone) submap.members.push_back(member.wall);
    }
    map.submaps.push_back(std::move(submap));
  }
  return map;
}

}  // namespace hallway::slam_plane
