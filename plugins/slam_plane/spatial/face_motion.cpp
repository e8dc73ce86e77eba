// SPDX-License-Identifier: MIT
// What FaceMap does with faces that move.
#include <vector>

#include "slam_plane/spatial/face_map.hpp"

namespace hallway::slam_plane::spatial {

bool FaceMap::follow(const Pose3& T_map_robot, const Sighting& sighting, bool stray,
                     std::uint64_t iteration) {
  FaceRecord& face = faces[sighting.face];
  face.trail.note(sighting, T_map_robot, face.plane, stray, iteration);
  const bool turns = !face.is_dynamic && face.trail.moves();
  if (turns) make_dynamic(sighting.face);
  std::erase_if(strayed_,
                [&](Index f) { return f == sighting.face || !faces[f].trail.is_followed(iteration); });
  if (!face.is_dynamic) {
    if (face.trail.is_followed(iteration)) strayed_.push_back(sighting.face);
    return false;
  }
  face.plane = face.trail.plane();
  face.outline = face.trail.outline();
  face.last_seen = iteration;
  ++face.observations;
  index_.put(sighting.face, face.outline);
  return turns;
}

/// Takes a face out of all submaps.
void FaceMap::make_dynamic(Index index) {
  FaceRecord& face = faces[index];
  face.is_dynamic = true;
  for (const MemberAt& at : face.members) {
    SubmapRecord& submap = submaps[at.submap];
    std::erase(submap.first_seen, index);
    submap.members[at.member] = Member{};
  }
  face.members.clear();
  face.edges.clear();
  count_edges(index);
  active_member_[index] = kNone;
}

}  // namespace hallway::slam_plane::spatial
