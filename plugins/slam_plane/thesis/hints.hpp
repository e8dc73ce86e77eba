// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "slam_plane/thesis/track_book.hpp"

namespace hallway::slam_plane::thesis {

/// "Do not let this track join that submap": what a roll back takes along into the past (Rules 32, 34).
struct Hint {
  Iteration iteration = 0;  ///< at which it had joined
  LandmarkId track = 0;     ///< its name: its id may be another one's by then
  SubmapIndex submap = 0;
};

/// The hints that hold, in the order of their iterations (thesis 4.4.3.16). Tracks are named.
class Hints {
 public:
  /// Adds one. Those of later iterations are dropped: what they speak of may not happen any more.
  void add(const Hint& hint) {
    std::erase_if(hints_, [&](const Hint& other) { return other.iteration > hint.iteration; });
    hints_.push_back(hint);
    ++strikes_[hint.track];
  }

  /// Whether a track may join a submap that there is.
  bool may_join(LandmarkId track, SubmapIndex submap) const {
    return strikes(track) < 2 && std::ranges::none_of(hints_, [&](const Hint& hint) {
             return hint.track == track && hint.submap == submap;
           });
  }

  /// How often a track was rolled back because it was compared over too little.
  int strikes(LandmarkId track) const {
    const auto found = strikes_.find(track);
    return found == strikes_.end() ? 0 : found->second;
  }

  /// Whether a track has had all the hints that one may have.
  bool exhausted(LandmarkId track) const { return strikes(track) >= 3; }

  /// Forgets hints of iterations that no roll back reaches any more: what they forbade was long ago and may be tried again.
  void forget_before(Iteration k) {
    std::erase_if(hints_, [&](const Hint& hint) { return hint.iteration < k; });
  }

  /// Forgets the tracks of which `may_be(name)` says that there will be none any more.
  template <typename MayBe>
  void forget_tracks(const MayBe& may_be) {
    std::erase_if(strikes_, [&](const auto& entry) { return !may_be(entry.first); });
  }

  /// Submaps got other indices: `now_at` of the one that they had.
  template <typename NowAt>
  void renumber(const NowAt& now_at) {
    for (Hint& hint : hints_) hint.submap = now_at(hint.submap);
  }

  std::size_t size() const { return hints_.size(); }

 private:
  std::vector<Hint> hints_;
  std::map<LandmarkId, int>
      strikes_;  // hints that a track ever got; so no track causes more than three roll backs
};

}  // namespace hallway::slam_plane::thesis
