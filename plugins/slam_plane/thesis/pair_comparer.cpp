// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_comparer.hpp"

#include <algorithm>
#include <tuple>

namespace hallway::slam_plane::thesis {

PairComparer::PairComparer(const CompareOptions& options, std::size_t max_pairs)
    : options_(options), max_pairs_(std::max<std::size_t>(max_pairs, 1)) {}

PairStatistics& PairComparer::statistics(const Track& a, const Track& b) {
  ++counters_.comparisons;
  const Key key{a.id(), b.id()};
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

Comparison PairComparer::compare(const Track& a, const Track& b) {
  if (b.id() < a.id()) return inverse(compare(b, a));
  PairStatistics& pair = statistics(a, b);
  candidates_.clear();
  for (const Interval& interval : comparable_intervals(a, b))
    candidates_.push_back(pair.summary(a, b, interval, options_));
  const IntervalSummary* best = best_summary(candidates_, options_);
  return best == nullptr ? Comparison{} : evaluate(*best, options_);
}

Comparison PairComparer::compare_in(const Track& a, const Track& b, const Interval& interval) {
  if (b.id() < a.id()) return inverse(compare_in(b, a, interval));
  return evaluate(statistics(a, b).summary(a, b, interval, options_), options_);
}

PairSums PairComparer::sums_in(const Track& a, const Track& b, const Interval& interval) {
  return statistics(a, b).sums(a, b, interval);
}

void PairComparer::truncate(Iteration k) {
  for (Entry& entry : entries_) entry.statistics.truncate(k);
}

void PairComparer::forget(TrackId id) {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->key.first == id || entry->key.second == id) {
      by_key_.erase(entry->key);
      entry = entries_.erase(entry);
    } else {
      ++entry;
    }
  }
}

KeyPoint recalculated_key(PairComparer& comparer, const Track& track, const Interval& interval,
                          std::span<const Track* const> others) {
  KeyPoint key = KeyPoint::none;
  std::tuple<bool, int> best{false, 0};  // not parallel, shared
  for (const Track* other : others) {
    if (other->id() == track.id()) continue;
    const Comparison comparison = comparer.compare_in(track, *other, interval);
    const std::tuple<bool, int> worth{!comparison.parallel, comparison.shared};
    if (!comparison.has_keys() || worth <= best) continue;
    best = worth;
    key = comparison.key[0];
  }
  return key;
}

}  // namespace hallway::slam_plane::thesis
