// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/tracks.hpp"

#include <algorithm>

namespace hallway::slam_point::thesis {

void Tracks::begin_iteration(Iteration iteration, bool planar) {
  now_ = iteration;
  planar_ = planar;
  std::vector<Index>& slot = chart_[iteration % kept_];
  for (const Index old : slot) {
    if (iteration >= kept_) tracks_[resolve(old)].history.forget_before(iteration - kept_ + 1);
  }
  slot.clear();
}

Index Tracks::add(const Vec3& position) {
  Track track;
  track.first = now_;
  track.position = in_plane(position);
  grid_.add(track.position);
  tracks_.push_back(std::move(track));
  listed_.push_back(0);
  return size() - 1;
}

void Tracks::see(Index index, const Vec3& point) {
  Track& track = tracks_[index];
  if (track.observations == 0) track.first_seen = point;
  ++track.observations;
  track.last = now_;
  track.history.add(now_, point);
  chart_[now_ % kept_].push_back(index);
}

void Tracks::place(Index track, const Vec3& position) {
  tracks_[track].position = in_plane(position);
  grid_.move(track, tracks_[track].position);
}

void Tracks::merge(Index into, Index from) {
  Track& kept = tracks_[into];
  Track& given = tracks_[from];
  kept.history.merge(given.history);
  kept.observations += given.observations;
  kept.last = std::max(kept.last, given.last);
  given.history = {};
  given.groups.clear();
  given.merged_into = into;
  grid_.remove(from);
}

const std::vector<Index>& Tracks::seen_between(Iteration first, Iteration last) {
  ++listing_;
  list_.clear();
  const Iteration oldest = now_ >= kept_ ? now_ - kept_ + 1 : 0;
  for (Iteration i = std::max(first, oldest); i <= std::min(last, now_); ++i) {
    for (const Index listed : chart_[i % kept_]) {
      const Index track = resolve(listed);
      if (listed_[track] == listing_) continue;
      listed_[track] = listing_;
      list_.push_back(track);
    }
  }
  return list_;
}

Index Tracks::resolve(Index track) const {
  while (tracks_[track].merged_into != kNone) track = tracks_[track].merged_into;
  return track;
}

}  // namespace hallway::slam_point::thesis
