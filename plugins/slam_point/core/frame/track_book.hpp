// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>

#include "slam_point/core/frame/frame.hpp"

namespace hallway::slam_point {

/// Which landmark each of the sensor's tracks has. Memory grows with the tracks, as the map does: each new one is a new
/// landmark.
class TrackBook {
 public:
  /// The landmark of a track, or what that was merged into; kNone for a track that is not known, and for kNoTrack.
  Index landmark_of(TrackId track, const SubmapGraph& graph) const;

  /// Takes note of whether a followed point was matched to its track's landmark. Whether it is to be a new landmark where it
  /// was not: when its track is new, or has not agreed three times in a row; once is an outlier.
  bool allows_new(const Observation& observation);

  /// The track's landmark is this one from now on. Does nothing for kNoTrack.
  void give(TrackId track, Index landmark);

  void clear() { entries_.clear(); }

 private:
  struct Entry {
    Index landmark = kNone;
    int misses = 0;  ///< frames in a row in which it lay elsewhere
  };
  std::unordered_map<TrackId, Entry> entries_;
};

}  // namespace hallway::slam_point
