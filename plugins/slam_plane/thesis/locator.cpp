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
  const std::vector<Member>& members = submap.members();
  for (std::size_t i = 1; i < members.size(); ++i) {
    const Comparison& comparison = members[i].comparison;
    if (!comparison.has_keys() || comparison.interval.last < now) continue;
    bool ends[2];
    static_ends(comparison, 0, options_.compare(), ends);
    note(members[i].parent, ends, now);
    static_ends(comparison, 1, options_.compare(), ends);
    note(members[i].track, ends, now);
  }
}

Reference Locator::seen(const Track& track, Iteration now) const {
  const Sighting& sighting = track.newest();
  Reference result;
  result.place.middle = sighting.segment.middle();
  result.place.direction = sighting.direction;
  result.place.size = sighting.length;
  result.place.valid = true;
  if (track.id() < static_.size() && static_[track.id()].at == now) {
    for (int end = 0; end < 2; ++end) result.known[end] = static_[track.id()].end[end];
  }
  return result;
}

void Locator::recalculate(TrackId id, std::span<const TrackId> tracks_now, const TrackBook& tracks,
                          PairComparer& comparer, Iteration now) {
  const Phase* phase = tracks[id].phase_at(now);
  if (phase == nullptr) return;
  std::vector<const Track*> others;
  for (const TrackId other : tracks_now) {
    if (other != id) others.push_back(&tracks[other]);
  }
  const KeyPoint key = recalculated_key(comparer, tracks[id], phase->interval, others);
  const bool ends[2] = {key == KeyPoint::left, key == KeyPoint::right};
  note(id, ends, now);
}

std::optional<Alignment> Locator::locate(std::span<const TrackId> tracks_now, const TrackBook& tracks,
                                         const MapBuilder& map, PairComparer& comparer, Iteration now,
                                         const Pose2& guess) {
  std::vector<PlanePair> pairs;
  for (const TrackId id : tracks_now) {
    const MappedPlane* plane = map.find(id);
    if (plane == nullptr) continue;
    if (id >= static_.size() || static_[id].at != now) recalculate(id, tracks_now, tracks, comparer, now);
    append_pairs(seen(tracks[id], now), plane->reference, pairs);
  }
  return align(pairs, guess);
}

}  // namespace hallway::slam_plane::thesis
