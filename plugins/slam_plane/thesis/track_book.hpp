// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "slam_plane/core/types.hpp"
#include "slam_plane/thesis/plane_track.hpp"

namespace hallway::slam_plane::thesis {

/// A submap's place in the list of submaps.
using SubmapIndex = std::size_t;

/// All tracks, and the submaps that each is a member of (thesis 4.4.3.1: the master list). A track's id is its place in the book, which is given again when the track is released or a
/// roll back takes it away; its *name* is what it is called outside, and is never another one's.
class TrackBook {
 public:
  static constexpr std::size_t kNoObservation = ~std::size_t{0};

  explicit TrackBook(const TrackOptions& options) : options_(options) {}

  /// A new track that begins in an iteration, with an observation of it. One that begins again where it began before a roll back has the name that it had. O(log(names kept)).
  PlaneTrack& create(Iteration now, std::size_t observation = kNoObservation) {
    if (free_.empty()) {
      free_.push_back(entries_.size());
      entries_.emplace_back(Entry{PlaneTrack(entries_.size(), options_), now, 0, {}, {}});
    }
    Entry& entry = entries_[free_.back()];
    free_.pop_back();
    entry.begun = now;
    entry.name = name_of(now, observation);
    return entry.track;
  }

  /// Highest id ever given, plus one. Some may be free.
  std::size_t size() const { return entries_.size(); }
  PlaneTrack& operator[](TrackId id) { return entries_[id].track; }
  const PlaneTrack& operator[](TrackId id) const { return entries_[id].track; }

  LandmarkId name(TrackId id) const { return entries_[id].name; }
  /// Whether there is no track of this id now.
  bool is_free(TrackId id) const { return entries_[id].begun == kFree; }

  /// Submaps that have the track as a member, in the order in which it joined.
  std::vector<SubmapIndex>& submaps(TrackId id) { return entries_[id].submaps; }
  const std::vector<SubmapIndex>& submaps(TrackId id) const { return entries_[id].submaps; }

  /// Submaps that only count the track when the current one is chosen (Rule 37).
  std::vector<SubmapIndex>& charted(TrackId id) { return entries_[id].charted; }
  const std::vector<SubmapIndex>& charted(TrackId id) const { return entries_[id].charted; }

  /// The track is no more, and its id may be given to another one.
  void release(TrackId id) {
    entries_[id] = Entry{PlaneTrack(id, options_), kFree, 0, {}, {}};
    free_.push_back(id);
  }

  /// Rolls back to iteration k: tracks begun later are no more. O(tracks).
  void truncate(Iteration k) {
    for (TrackId id = entries_.size(); id-- > 0;) {
      if (entries_[id].begun > k) {
        release(id);
      } else {
        entries_[id].track.truncate(k);
      }
    }
  }

  /// The names of all tracks, and of those that may begin again after a roll back, ascending. O(n log n).
  std::vector<LandmarkId> names() const {
    std::vector<LandmarkId> result;
    for (const Entry& entry : entries_) {
      if (entry.begun != kFree) result.push_back(entry.name);
    }
    for (const auto& [where, name] : names_) result.push_back(name);
    std::ranges::sort(result);
    return result;
  }

  /// Forgets what tracks were called that began before iteration k: no roll back takes those away. O(forgotten).
  void forget_names_before(Iteration k) {
    while (!names_.empty() && names_.begin()->first.first < k) names_.erase(names_.begin());
  }

 private:
  static constexpr Iteration kFree = -1;

  struct Entry {
    PlaneTrack track;
    Iteration begun;  // or kFree
    LandmarkId name;
    std::vector<SubmapIndex> submaps;
    std::vector<SubmapIndex> charted;
  };

  LandmarkId name_of(Iteration now, std::size_t observation) {
    if (observation == kNoObservation) return next_name_++;
    const auto [found, fresh] = names_.try_emplace({now, observation}, next_name_);
    if (fresh) ++next_name_;
    return found->second;
  }

  TrackOptions options_;
  std::deque<Entry> entries_;                                      // what points to a track stays good
  std::vector<TrackId> free_;                                      // the last one is given next
  std::map<std::pair<Iteration, std::size_t>, LandmarkId> names_;  // by where a track began
  LandmarkId next_name_ = 0;
};

}  // namespace hallway::slam_plane::thesis
