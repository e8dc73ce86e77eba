// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/steps.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

void anchor(TrackId track, KeyPoint key, Submap& submap, const State& state) {
  if (state.tracks[track].first().iteration != state.start) return;
  auto at = std::ranges::find(submap.anchors, track, &Anchor::track);
  if (at == submap.anchors.end()) {
    submap.anchors.push_back({track, reference_of(state.tracks[track].first())});
    at = std::prev(submap.anchors.end());
  }
  if (key != KeyPoint::none) at->reference.known[end_of(key)] = true;
}

}  // namespace

void anchor_first(State& state) {
  Submap& first = state.submaps.front();
  for (std::size_t i = 0; i < first.members().size(); ++i) {
    const Member& member = first.members()[i];
    if (!member.comparison.valid || !member.comparison.interval.contains(state.start)) continue;
    anchor(member.parent, member.comparison.key[0], first, state);
    anchor(member.track, member.comparison.key[1], first, state);
  }
}

std::uint64_t anchor_by_pose(const Alignment& location, State& state) {
  std::uint64_t fixed = 0;
  for (const SubmapIndex index : state.unanchored) {
    Submap& submap = state.submaps[index];
    if (submap.placed || (!submap.by_motion && !location.by_points)) continue;
    std::vector<PlanePair> pairs;
    for (const Member& member : submap.members()) {
      if (!member.reference.valid() || !std::ranges::binary_search(state.seen, member.track)) continue;
      append_pairs(member.reference, state.locator.seen(state.tracks[member.track], state.now), pairs);
    }
    const std::optional<Alignment> T_robot_submap = align(pairs, Pose2{});
    if (!T_robot_submap || !T_robot_submap->by_points) continue;
    const Pose2 T = location.T_to_from * T_robot_submap->T_to_from;
    for (const Member& member : submap.members()) {
      if (member.reference.valid()) submap.anchors.push_back({member.track, moved(T, member.reference)});
    }
    submap.anchored = state.now;
    ++fixed;
  }
  return fixed;
}

}  // namespace hallway::slam_plane::thesis
