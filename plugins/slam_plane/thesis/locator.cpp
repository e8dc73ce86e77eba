// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/locator.hpp"

namespace hallway::slam_plane::thesis {

void Locator::note(TrackId track, const bool (&ends)[2], Iteration now) {
  if (static_.size() <= track) static_.resize(track + 1);
  StaticEnds& noted = static_[track];
  if (noted.at != now) noted = {now, {false, false}};
  for (int end = 0; end < 2; ++end) noted.end[end] = noted.end[end] || ends[end];
}

void Locator::note(const Submap& submap, Iteration now) {
  for (const Member& member : submap.members()) {
    if (member.still[0] || member.still[1]) note(member.track, member.still, now);
  }
}

Reference Locator::seen(const PlaneTrack& track, Iteration now) const {
  Reference result = reference_of(track.newest());
  if (track.id() < static_.size() && static_[track.id()].at == now) {
    for (int end = 0; end < 2; ++end) result.known[end] = static_[track.id()].end[end];
  }
  return result;
}

void Locator::recalculate(TrackId id, std::span<const TrackId> tracks_now, const TrackBook& tracks,
                          StaticPairs& pairs, Iteration now) {
  for (const TrackId other : tracks_now) {
    if (other == id) continue;
    const PairHistory& history = pairs.update(tracks[id], tracks[other]);
    const int which = other < id ? 1 : 0;
    if (history.updated != now) continue;
    const bool still[2] = {history.still(which, kEndA), history.still(which, kEndB)};
    if (!still[0] && !still[1]) continue;
    note(id, still, now);
    return;
  }
}

std::optional<Alignment> Locator::locate(std::span<const TrackId> tracks_now, const TrackBook& tracks,
                                         const MapBuilder& map, StaticPairs& pairs, Iteration now,
                                         const Pose2& guess) {
  std::vector<PlanePair> evidence;
  for (const TrackId id : tracks_now) {
    const PlaneLandmark* plane = map.find(id);
    if (plane == nullptr) continue;
    if (id >= static_.size() || static_[id].at != now) recalculate(id, tracks_now, tracks, pairs, now);
    append_pairs(seen(tracks[id], now), plane->reference, evidence);
  }
  leave_out_jumps(guess, options_.match_distance_m, evidence);
  return align(evidence, guess);
}

}  // namespace hallway::slam_plane::thesis
