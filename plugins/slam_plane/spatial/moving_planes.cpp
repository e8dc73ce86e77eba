// SPDX-License-Identifier: MIT
// What PlaneMap does with planes that move.
#include <vector>

#include "slam_plane/spatial/plane_map.hpp"

namespace hallway::slam_plane::spatial {

bool PlaneMap::follow(const Pose& T_map_robot, const AssociatedObservation& observation, bool outlier,
                      std::uint64_t iteration) {
  PlaneRecord& landmark = landmarks[observation.landmark];
  landmark.trail.note(observation, T_map_robot, landmark.plane, outlier, iteration);
  const bool turns = !landmark.is_dynamic && landmark.trail.moves();
  if (turns) make_dynamic(observation.landmark);
  std::erase_if(displaced_, [&](Index f) {
    return f == observation.landmark || !landmarks[f].trail.is_followed(iteration);
  });
  if (!landmark.is_dynamic) {
    if (landmark.trail.is_followed(iteration)) displaced_.push_back(observation.landmark);
    return false;
  }
  landmark.plane = landmark.trail.plane();
  landmark.outline = landmark.trail.outline();
  landmark.last_seen = iteration;
  ++landmark.observations;
  index_.put(observation.landmark, landmark.outline);
  return turns;
}

/// Takes a plane out of all submaps.
void PlaneMap::make_dynamic(Index index) {
  PlaneRecord& landmark = landmarks[index];
  landmark.is_dynamic = true;
  for (const Membership& at : landmark.members) {
    SubmapRecord& submap = submaps[at.submap];
    std::erase(submap.first_seen, index);
    submap.members[at.member] = Member{};
  }
  landmark.members.clear();
  landmark.edges.clear();
  count_edges(index);
  active_member_[index] = kNone;
}

}  // namespace hallway::slam_plane::spatial
