// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/track_book.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMostMisses = 2;  // in a row; one more, and the track is on another point

}  // namespace

Index TrackBook::landmark_of(TrackId track, const SubmapGraph& graph) const {
  const auto found = entries_.find(track);
  return found == entries_.end() ? kNone : graph.survivor(found->second.landmark);
}

bool TrackBook::allows_new(const Observation& observation) {
  if (observation.expected == kNone) return true;
  Entry& entry = entries_.at(observation.track);
  entry.misses = observation.landmark == kNone ? entry.misses + 1 : 0;
  return entry.misses > kMostMisses;
}

void TrackBook::give(TrackId track, Index landmark) {
  if (track != kNoTrack) entries_[track] = {landmark, 0};
}

}  // namespace hallway::slam_point
