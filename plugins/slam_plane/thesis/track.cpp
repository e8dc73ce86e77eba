// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/track.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hallway::slam_plane::thesis {
namespace {

constexpr std::int64_t kBlock = 32;     // sightings whose largest lengths are kept together
constexpr int kMaxCapacity = 16384;     // what the sums of pairs allow
constexpr double kEqualLengths = 1e-9;  // [m]

}  // namespace

Track::Track(TrackId id, const TrackOptions& options)
    : id_(id), options_(options), sightings_(static_cast<std::size_t>(std::max(options.capacity, 0))) {
  if (options.capacity < 2 * options.trend_window || options.capacity > kMaxCapacity ||
      options.trend_window < 1)
    throw std::invalid_argument("track: a capacity of " + std::to_string(options.capacity) +
                                " observations and a window of " + std::to_string(options.trend_window) +
                                ": at least twice the window, at most " + std::to_string(kMaxCapacity));
}

void Track::push(const Sighting& sighting) {
  if (!empty() && sighting.iteration <= newest().iteration)
    throw std::invalid_argument("track: iteration " + std::to_string(sighting.iteration) + " comes after " +
                                std::to_string(newest().iteration));
  Kept kept{sighting, {}, sighting.iteration};
  const bool continues = !empty() && sighting.iteration - newest().iteration - 1 <=
                                         static_cast<Iteration>(options_.gap_iterations);
  if (continues) {
    kept.detector = sightings_.back().detector;
    kept.run_first = sightings_.back().run_first;
  }
  if (pushed_ == 0) first_ = sighting;
  if (sightings_.size() == sightings_.capacity()) drop_oldest();
  sightings_.push_back(kept);
  ++pushed_;
  index_newest();
  if (continues) {
    phases_.back().interval.last = sighting.iteration;
  } else {
    phases_.push_back({{sighting.iteration, sighting.iteration}, Trend::steady, sighting.iteration});
  }
  watch_trend();
}

void Track::watch_trend() {
  Kept& now = sightings_[sightings_.size() - 1];
  double sum = 0.0;
  int count = 0;
  const Sighting* peak = &now.sighting;
  const Sighting* dip = &now.sighting;
  for (std::size_t i = sightings_.size(); i-- > 0 && count < options_.trend_window; ++count) {
    const Sighting& sighting = sightings_[i].sighting;
    if (sighting.iteration < now.run_first) break;
    sum += sighting.length;
    if (sighting.length > peak->length + kEqualLengths) peak = &sighting;
    if (sighting.length < dip->length - kEqualLengths) dip = &sighting;
  }
  if (count > 2) {  // a single sighting of a wrong size is no trend (Rule 20)
    sum -= peak->length + dip->length;
    count -= 2;
  }
  const auto turned =
      now.detector.add(sum / count, peak->iteration, dip->iteration, options_.trend_hysteresis_m);
  if (turned) split(*turned);
  phases_.back().trend = now.detector.trend();
}

void Track::split(Iteration end) {
  Phase& old = phases_.back();
  const Iteration last = std::max(end, old.interval.first);
  const Iteration next = (*this)[lower_bound(last + 1)].iteration;
  const Phase fresh{{next, newest().iteration}, Trend::steady, newest().iteration};
  old.interval.last = (*this)[lower_bound(last + 1) - 1].iteration;
  phases_.push_back(fresh);
}

void Track::index_newest() {
  const std::int64_t block = (pushed_ - 1) / kBlock;
  if (blocks_.empty()) first_block_ = block;
  if (block == first_block_ + static_cast<std::int64_t>(blocks_.size())) blocks_.emplace_back();
  blocks_.back().add(newest().length, newest().iteration);
}

void Track::drop_oldest() {
  const std::int64_t second = pushed_ - static_cast<std::int64_t>(sightings_.size()) + 1;
  if (second / kBlock > first_block_) {
    blocks_.pop_front();
    ++first_block_;
  }
  const Iteration oldest_left = sightings_[1].sighting.iteration;
  if (phases_.front().interval.last < oldest_left) {
    phases_.pop_front();
  } else {
    phases_.front().interval.first = oldest_left;
  }
}

bool Track::truncate(Iteration k) {
  if (empty() || newest().iteration <= k) return !empty();
  while (!empty() && newest().iteration > k) {
    sightings_.pop_back();
    --pushed_;
  }
  truncate_index();
  while (!phases_.empty() && phases_.back().known_since > k) phases_.pop_back();
  if (empty()) {
    phases_.clear();
    return false;
  }
  // The phase of that time may have gone as too old after its successor was known.
  if (phases_.empty()) phases_.push_back({{oldest().iteration, k}, Trend::steady, oldest().iteration});
  phases_.back().interval.last = newest().iteration;
  phases_.back().trend = sightings_.back().detector.trend();
  return true;
}

void Track::forget() {
  sightings_ = RingBuffer<Kept>(sightings_.capacity());
  phases_ = {};
  blocks_ = {};
}

void Track::truncate_index() {
  if (empty()) {
    blocks_.clear();
    return;
  }
  const std::int64_t last = (pushed_ - 1) / kBlock;
  while (first_block_ + static_cast<std::int64_t>(blocks_.size()) - 1 > last) blocks_.pop_back();
  blocks_.back().clear();
  const std::int64_t oldest_number = pushed_ - static_cast<std::int64_t>(size());
  for (std::int64_t n = std::max(last * kBlock, oldest_number); n < pushed_; ++n) {
    const Sighting& sighting = (*this)[static_cast<std::size_t>(n - oldest_number)];
    blocks_.back().add(sighting.length, sighting.iteration);
  }
}

std::size_t Track::lower_bound(Iteration k) const {
  if (empty() || newest().iteration < k) return size();
  if (k <= oldest().iteration) return 0;
  // There is at most one sighting an iteration, and mostly one in each.
  const auto since = static_cast<std::size_t>(newest().iteration - k) + 1;
  std::size_t low = size() - std::min(since, size()), high = size();
  if ((*this)[low].iteration >= k) return low;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if ((*this)[middle].iteration < k) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

const Sighting* Track::find(Iteration k) const {
  const std::size_t i = lower_bound(k);
  return i < size() && (*this)[i].iteration == k ? &(*this)[i] : nullptr;
}

const Phase* Track::phase_at(Iteration k) const {
  const auto after =
      std::upper_bound(phases_.begin(), phases_.end(), k,
                       [](Iteration at, const Phase& phase) { return at < phase.interval.first; });
  if (after == phases_.begin() || !(after - 1)->interval.contains(k)) return nullptr;
  return &*(after - 1);
}

Intervals Track::visible() const {
  Intervals result;
  for (const Phase& phase : phases_) {
    if (!result.empty() && phase.interval.first - result.back().last - 1 <= options_.gap_iterations) {
      result.back().last = phase.interval.last;
    } else {
      result.push_back(phase.interval);
    }
  }
  return result;
}

LargestLengths Track::largest(const Interval& interval) const {
  LargestLengths result;
  const std::int64_t oldest_number = pushed_ - static_cast<std::int64_t>(size());
  const std::int64_t end = oldest_number + static_cast<std::int64_t>(lower_bound(interval.last + 1));
  for (std::int64_t n = oldest_number + static_cast<std::int64_t>(lower_bound(interval.first)); n < end;) {
    if (n % kBlock == 0 && n + kBlock <= end) {
      result.add(blocks_[static_cast<std::size_t>(n / kBlock - first_block_)]);
      n += kBlock;
    } else {
      const Sighting& sighting = (*this)[static_cast<std::size_t>(n - oldest_number)];
      result.add(sighting.length, sighting.iteration);
      ++n;
    }
  }
  return result;
}

bool TrackSize::excludes(Iteration k) const {
  return std::find(outlier.begin(), outlier.begin() + outliers, k) != outlier.begin() + outliers;
}

TrackSize backed_size(const LargestLengths& largest, const CompareOptions& options) {
  TrackSize result;
  result.outliers = largest.outliers(options.size_backing, options.size_tolerance_m);
  for (int i = 0; i < result.outliers; ++i)
    result.outlier[static_cast<std::size_t>(i)] = largest[i].iteration;
  if (largest.count() > 0) result.size = largest[result.outliers].length;
  return result;
}

TrackSize size_in(const Track& track, const Interval& interval, const CompareOptions& options) {
  return backed_size(track.largest(interval), options);
}

}  // namespace hallway::slam_plane::thesis
