// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "slam_plane/thesis/track_book.hpp"

namespace hallway::slam_plane::thesis {

/// "Do not let this track join that submap": what a roll back takes along into the past (Rules 32, 34).
struct Hint {
  Iteration iteration = 0;  ///< at which it had joined
  TrackId track = 0;
  SubmapIndex submap = 0;
};

/// The hints that hold, in the order of their iterations (thesis 4.4.3.16).
class Hints {
 public:
  /// Adds one. Those of later iterations are dropped: what they speak of may not happen any more.
  void add(const Hint& hint) {
    std::erase_if(hints_, [&](const Hint& other) { return other.iteration > hint.iteration; });
    hints_.push_back(hint);
    ++added_;
  }

  /// Whether a track may join a submap that there is.
  bool may_join(TrackId track, SubmapIndex submap) const {
    return count(track) < 2 && std::none_of(hints_.begin(), hints_.end(), [&](const Hint& hint) {
             return hint.track == track && hint.submap == submap;
           });
  }

  /// Whether a track may cause a new submap; after three hints it is left out of the map.
  bool may_begin(TrackId track) const { return count(track) < 3; }

  /// Forgets hints that no roll back can reach any more.
  void forget_before(Iteration k) {
    std::erase_if(hints_, [&](const Hint& hint) { return hint.iteration < k; });
  }

  std::size_t size() const { return hints_.size(); }
  std::size_t added() const { return added_; }

 private:
  std::ptrdiff_t count(TrackId track) const {
    return std::count_if(hints_.begin(), hints_.end(), [&](const Hint& hint) { return hint.track == track; });
  }

  std::vector<Hint> hints_;
  std::size_t added_ = 0;
};

}  // namespace hallway::slam_plane::thesis
