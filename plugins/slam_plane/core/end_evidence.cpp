// SPDX-License-Identifier: MIT
#include "slam_plane/core/end_evidence.hpp"

#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr std::uint32_t kLeastAgainst = 3;  // observations beyond a corner that disprove it
constexpr double kAgainstSigmas = 4.0;
constexpr double kBeyond_m = 0.03;
constexpr double kSamePlace_m = 0.15;  // of ends that are seen in one place

}  // namespace

EndEvidence::Against EndEvidence::compare(const WallEstimate& wall, const Vec2& place, int end,
                                          double slack) const {
  if (!wall.known[end]) return {};
  const double own2 = noise_.end_variance();
  const double off = wall.basis.along(place) - wall.end[end];
  const double gate = kAgainstSigmas * std::sqrt(own2 + wall.variance[end]) + slack;

  return {outward(end) * off > gate + kBeyond_m, std::abs(off) > gate};
}

/// Of the end where the wall was seen farthest.
void EndEvidence::note_hidden(const Frame& frame, const AssociatedObservation& observation,
                              WallRecord& wall) {
  if (wall.count == 0) return;
  for (int k = 0; k < 2; ++k) {
    const double place = wall.estimate.basis.along(frame.T_map_robot * observation.end[k]);
    const double beyond = outward(k) * (place - wall.estimate.reach[k]);
    if (beyond > kSamePlace_m) wall.hidden[k] = 0;
    if (observation.hidden[k] && beyond > -kSamePlace_m) ++wall.hidden[k];
  }
}

void EndEvidence::judge(const OpenGaps& gaps, const Frame& frame, const AssociatedObservation& observation,
                        WallMap& map, bool (&corner)[2]) const {
  WallRecord& wall = map.walls[observation.wall];
  note_hidden(frame, observation, wall);
  const SubmapRecord& submap = map.submaps[map.active()];
  corner[kEndA] = corner[kEndB] = false;
  if (submap.lines_only) return;
  const Member& member = submap.members[wall.active_member];
  for (int k = 0; k < 2; ++k) {
    corner[k] = observation.corner[k];
    Against local, global;
    if (member.evidence.count() > 0)
      local = compare(member.estimate, frame.T_submap_robot * observation.end[k], k, 0.0);
    if (gaps.empty() || wall.epoch >= gaps.last().epoch)
      global = compare(wall.estimate, frame.T_map_robot * observation.end[k], k, map_bound_m_);
    if (local.beyond || global.beyond) ++wall.against[k];
    if (!gaps.empty() && gaps.last().is_wide() && wall.corners[k] > 0 &&
        wall.corner_epoch[k] < gaps.last().epoch)
      corner[k] = false;  // it is known where it was, and not yet where this is
    if (corner[k] && (local.astray || global.astray)) {
      ++wall.astray[k];
      corner[k] = false;
    }
  }
}

bool EndEvidence::is_disproved(const WallRecord& wall, int end) {
  return (wall.against[end] >= kLeastAgainst && 20 * wall.against[end] > wall.corners[end]) ||
         wall.astray[end] > wall.corners[end] + 2 * kLeastAgainst;
}

}  // namespace hallway::slam_plane
