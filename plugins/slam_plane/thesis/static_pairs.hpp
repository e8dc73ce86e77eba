// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/pair_comparer.hpp"
#include "slam_plane/thesis/stillness.hpp"

namespace hallway::slam_plane::thesis {

/// An interval that lasts until now, in which an end of each of two planes stands still.
struct EndRun {
  Iteration since = -1;   ///< it began here; -1: the two ends are not known to stand still
  OffsetMoments moments;  ///< of the offset between the ends, when that was looked at last
  int misses = 0;         ///< newest observations in a row that do not agree with them
  bool undefined =
      false;  ///< the other end of one of the planes seems to stand still too, but its length changes (Rule 15)

  bool still() const { return since >= 0 && misses == 0 && !undefined; }
};

/// What is known of two planes: the first one has the smaller id.
struct PairHistory {
  Iteration updated = -1;      ///< newest shared observation that was looked at
  std::array<EndRun, 4> runs;  ///< by 2 * end of the first plane + end of the second one
  std::vector<Comparison>
      saved;  ///< the best one for each two ends that ever stood still, the longest first (Rule 36)

  std::uint64_t disproved =
      0;  ///< what was known of ends that are no corners, when `saved` was compared with it

  EndRun& run(int combination) { return runs[static_cast<std::size_t>(combination)]; }
  /// Whether an end of the first plane (0) or of the second one (1) stands still, as far as the pair tells.
  bool still(int which, int end) const;
  /// Iterations that the best comparison was made over.
  int shared() const { return saved.empty() ? 0 : saved.front().shared; }
};

/// Finds out, for each pair of planes and each two ends of theirs, when both stand still, and compares the planes over those intervals (Rules 13, 36). An interval goes on
/// until an end moves or one of the planes turns from growing to shrinking or back (Rule 18).
class StaticPairs {
 public:
  explicit StaticPairs(const CompareOptions& options) : options_(options), comparer_(options) {}

  /// Takes in what was pushed to both tracks. O(log n) a new observation; every fourth one O(log² n).
  const PairHistory& update(const PlaneTrack& a, const PlaneTrack& b);

  /// `child` relative to `parent`, from one of the comparisons of their history.
  static Comparison oriented(const Comparison& comparison, const PlaneTrack& parent,
                             const PlaneTrack& child) {
    return child.id() < parent.id() ? inverse(comparison) : comparison;
  }

  PairComparer& comparer() { return comparer_; }
  const PairComparer& comparer() const { return comparer_; }

  /// Rolls back to iteration k: what was found later is found again. O(pairs).
  void truncate(Iteration k);

  /// Forgets all pairs with a track. O(pairs of it * log(all)).
  void forget(TrackId id);

 private:
  PairHistory& begin(TrackId a, TrackId b);
  void split_where_turned(const PlaneTrack& a, const PlaneTrack& b, Iteration start, PairHistory& pair);
  void follow(NewestShared& newest, bool due, PairHistory& pair);
  void search(NewestShared& newest, Iteration start, PairHistory& pair);
  void search_exact(NewestShared& newest, Iteration start, PairHistory& pair);
  bool may_move_alike(const PlaneTrack& a, const PlaneTrack& b, int combination, const EndRun& run,
                      Iteration now) const;
  void judge_runs(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair);
  void find_lines(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair);
  void end_run(const PlaneTrack& a, const PlaneTrack& b, int combination, PairHistory& pair);
  void shorten(const PlaneTrack& a, const PlaneTrack& b, int combination, Iteration last, PairHistory& pair);
  void keep_better(const PlaneTrack& a, const PlaneTrack& b, const Comparison& made, PairHistory& pair);
  void drop_disproved(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair);
  void save(const PlaneTrack& a, const PlaneTrack& b, int combination, PairHistory& pair);

  CompareOptions options_;
  PairComparer comparer_;
  std::unordered_map<TrackPair, PairHistory, TrackPairHash> pairs_;  // of planes that were seen together
  std::map<std::pair<TrackId, KeyPoint>, Iteration>
      firm_;  // ends that stood still to a plane that is not parallel, when last
  std::map<TrackId, std::vector<TrackId>> partners_;  // with whom a track was compared
  std::map<std::pair<TrackId, KeyPoint>, Iteration>
      corner_since_;             // ends that were taken for another place before
  std::uint64_t disproved_ = 1;  // counts changes of it
};

}  // namespace hallway::slam_plane::thesis
