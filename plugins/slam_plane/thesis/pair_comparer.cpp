// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_comparer.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {

PairComparer::PairComparer(const CompareOptions& options, std::size_t max_pairs)
    : options_(options), max_pairs_(std::max<std::size_t>(max_pairs, 1)) {}

PairStatistics& PairComparer::statistics(const PlaneTrack& a, const PlaneTrack& b) {
  ++counters_.comparisons;
  const TrackPair key{a.id(), b.id()};
  if (const auto found = by_key_.find(key); found != by_key_.end()) {
    ++counters_.hits;
    entries_.splice(entries_.begin(), entries_, found->second);
  } else {
    if (by_key_.size() == max_pairs_) {
      ++counters_.discarded;
      by_key_.erase(entries_.back().key);
      entries_.pop_back();
    }
    entries_.push_front({key, PairStatistics(std::min(a.capacity(), b.capacity()))});
    by_key_[key] = entries_.begin();
  }
  PairStatistics& statistics = entries_.front().statistics;
  statistics.update(a, b);
  return statistics;
}

Comparison PairComparer::compare_in(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval,
                                    int combination) {
  if (b.id() < a.id()) return inverse(compare_in(b, a, interval, turned_round(combination)));
  return evaluate(statistics(a, b).summary(a, b, interval, options_), combination, options_);
}

void PairComparer::truncate(Iteration k) {
  for (Entry& entry : entries_) entry.statistics.truncate(k);
}

void PairComparer::forget(TrackId a, TrackId b) {
  const auto found = by_key_.find({std::min(a, b), std::max(a, b)});
  if (found == by_key_.end()) return;
  entries_.erase(found->second);
  by_key_.erase(found);
}

}  // namespace hallway::slam_plane::thesis
