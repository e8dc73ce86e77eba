// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "slam_plane/thesis/track.hpp"

namespace hallway::slam_plane::thesis {

/// A submap's place in the list of submaps.
using SubmapIndex = std::size_t;

/// All tracks, by name, and the submaps that each is a member of (thesis 4.4.3.1: the master list).
class TrackBook {
 public:
  explicit TrackBook(const TrackOptions& options) : options_(options) {}

  /// A new track that begins in an iteration.
  Track& create(Iteration now) {
    begun_.push_back(now);
    tracks_.emplace_back(tracks_.size(), options_);
    submaps_.emplace_back();
    charted_.emplace_back();
    return tracks_.back();
  }

  std::size_t size() const { return tracks_.size(); }
  Track& operator[](TrackId id) { return tracks_[id]; }
  const Track& operator[](TrackId id) const { return tracks_[id]; }

  /// Submaps that have the track as a member, in the order in which it joined.
  std::vector<SubmapIndex>& submaps(TrackId id) { return submaps_[id]; }
  const std::vector<SubmapIndex>& submaps(TrackId id) const { return submaps_[id]; }

  /// Submaps that only count the track when the current one is chosen (Rule 37).
  std::vector<SubmapIndex>& charted(TrackId id) { return charted_[id]; }
  const std::vector<SubmapIndex>& charted(TrackId id) const { return charted_[id]; }

  /// Rolls back to iteration k: tracks begun later are no more. O(tracks).
  void truncate(Iteration k) {
    while (!tracks_.empty() && begun_.back() > k) {
      begun_.pop_back();
      tracks_.pop_back();
      submaps_.pop_back();
      charted_.pop_back();
    }
    for (Track& track : tracks_) track.truncate(k);
  }

 private:
  TrackOptions options_;
  std::deque<Track> tracks_;  // what points to one stays good
  std::vector<Iteration> begun_;
  std::vector<std::vector<SubmapIndex>> submaps_;
  std::vector<std::vector<SubmapIndex>> charted_;
};

}  // namespace hallway::slam_plane::thesis
