// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/pair_comparer.hpp"

namespace hallway::slam_plane::thesis {

/// The intervals in which an end of each of two planes stood still, as far as they matter.
struct PairHistory {
  Iteration updated = -1;  ///< newest shared sighting that was looked at
  Iteration since =
      -1;  ///< the interval that lasts until then began here; -1: no end of one stands still to an end of the other
  Comparison current;     ///< on [since, updated]; its mean may be a few sightings older
  bool still[2][2] = {};  ///< [plane][end]: stood still since then, and still does
  std::vector<Comparison>
      saved;  ///< the best one for each two ends that ever stood still, the longest first (Rule 36)

  /// Iterations that the best comparison was made over.
  int shared() const { return saved.empty() ? 0 : saved.front().shared; }
};

/// Splits the time of pairs of planes (Rule 18): finds where the offset between two of their ends keeps its mean and its deviation, which is where both ends are static
/// (Rule 13). An interval is tested by its two halves; so a deviation is judged by that of the pair itself, and no noise has to be known.
///
/// Parallel planes are never compared this way: ends that move together stand still to each other (Rule 15).
class StaticPairs {
 public:
  explicit StaticPairs(const CompareOptions& options) : options_(options), comparer_(options) {}

  /// Takes in what was pushed to both tracks. O(log n) a new sighting, O(n) where an end began to move.
  const PairHistory& update(const Track& a, const Track& b);

  /// `child` relative to `parent`, as the best of what a history has; of histories without any, not valid.
  static Comparison oriented(const Comparison& comparison, const Track& parent, const Track& child) {
    return child.id() < parent.id() ? inverse(comparison) : comparison;
  }

  PairComparer& comparer() { return comparer_; }
  const PairComparer& comparer() const { return comparer_; }

  /// Rolls back to iteration k: what was found later is found again. O(pairs).
  void truncate(Iteration k);

  /// Forgets all pairs with a track.
  void forget(TrackId id);

 private:
  using Key = std::pair<TrackId, TrackId>;

  struct Block {
    PairSums sums;
    int combination = 0;
    bool exact = false;  // without any deviation
  };

  std::optional<Block> still(const Track& a, const Track& b, const Interval& interval);
  bool goes_on(const Track& a, const Track& b, PairHistory& pair);
  void extend(const Track& a, const Track& b, PairHistory& pair);
  void search(const Track& a, const Track& b, PairHistory& pair);
  void evaluate(const Track& a, const Track& b, PairHistory& pair);

  CompareOptions options_;
  PairComparer comparer_;
  std::map<Key, PairHistory> pairs_;
};

}  // namespace hallway::slam_plane::thesis
