// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/plane_track.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hallway::slam_plane::thesis {
namespace {

constexpr std::int64_t kBlock = 32;     // observations whose largest lengths are kept together
constexpr int kMaxCapacity = 16384;     // what the sums of pairs allow
constexpr double kEqualLengths = 1e-9;  // [m]

}  // namespace

PlaneTrack::PlaneTrack(TrackId id, const TrackOptions& options)
    : id_(id), options_(options), observations_(static_cast<std::size_t>(std::max(options.capacity, 0))) {
  if (options.capacity < 2 * options.trend_window || options.capacity > kMaxCapacity ||
      options.trend_window < 1)
    throw std::invalid_argument("track: a capacity of " + std::to_string(options.capacity) +
                                " observations and a window of " + std::to_string(options.trend_window) +
                                ": at least twice the window, at most " + std::to_string(kMaxCapacity));
}

void PlaneTrack::push(const TimedObservation& observation) {
  if (!empty() && observation.iteration <= newest().iteration)
    throw std::invalid_argument("track: iteration " + std::to_string(observation.iteration) +
                                " comes after " + std::to_string(newest().iteration));
  Kept kept{observation, {}, observation.iteration};
  const bool continues = !empty() && observation.iteration - newest().iteration - 1 <=
                                         static_cast<Iteration>(options_.gap_iterations);
  if (continues) {
    kept.detector = observations_.back().detector;
    kept.run_first = observations_.back().run_first;
  }
  if (pushed_ == 0) first_ = observation;
  if (observations_.size() == observations_.capacity()) drop_oldest();
  observations_.push_back(kept);
  ++pushed_;
  index_newest();
  if (continues) {
    phases_.back().interval.last = observation.iteration;
  } else {
    phases_.push_back({{observation.iteration, observation.iteration}, Trend::steady, observation.iteration});
  }
  watch_trend();
}

void PlaneTrack::watch_trend() {
  Kept& now = observations_[observations_.size() - 1];
  double sum = 0.0;
  int count = 0;
  const TimedObservation* peak = &now.observation;
  const TimedObservation* dip = &now.observation;
  for (std::size_t i = observations_.size(); i-- > 0 && count < options_.trend_window; ++count) {
    const TimedObservation& observation = observations_[i].observation;
    if (observation.iteration < now.run_first) break;
    sum += observation.length;
    if (observation.length > peak->length + kEqualLengths) peak = &observation;
    if (observation.length < dip->length - kEqualLengths) dip = &observation;
  }
  if (count > 2) {  // a single observation of a wrong size is no trend (Rule 20)
    sum -= peak->length + dip->length;
    count -= 2;
  }
  const auto turned =
      now.detector.add(sum / count, peak->iteration, dip->iteration, options_.trend_hysteresis_m);
  if (turned) split(*turned);
  phases_.back().trend = now.detector.trend();
}

void PlaneTrack::split(Iteration end) {
  Phase& old = phases_.back();
  const Iteration last = std::max(end, old.interval.first);
  const Iteration next = (*this)[lower_bound(last + 1)].iteration;
  const Phase fresh{{next, newest().iteration}, Trend::steady, newest().iteration};
  old.interval.last = (*this)[lower_bound(last + 1) - 1].iteration;
  phases_.push_back(fresh);
}

void PlaneTrack::index_newest() {
  const std::int64_t block = (pushed_ - 1) / kBlock;
  if (blocks_.empty()) first_block_ = block;
  if (block == first_block_ + static_cast<std::int64_t>(blocks_.size())) blocks_.emplace_back();
  blocks_.back().add(newest().length, newest().iteration);
}

void PlaneTrack::drop_oldest() {
  const std::int64_t second = pushed_ - static_cast<std::int64_t>(observations_.size()) + 1;
  if (second / kBlock > first_block_) {
    blocks_.pop_front();
    ++first_block_;
  }
  const Iteration oldest_left = observations_[1].observation.iteration;
  if (phases_.front().interval.last < oldest_left) {
    phases_.pop_front();
  } else {
    phases_.front().interval.first = oldest_left;
  }
}

bool PlaneTrack::truncate(Iteration k) {
  if (empty() || newest().iteration <= k) return !empty();
  while (!empty() && newest().iteration > k) {
    observations_.pop_back();
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
  phases_.back().trend = observations_.back().detector.trend();
  return true;
}

void PlaneTrack::forget() {
  observations_ = RingBuffer<Kept>(observations_.capacity());
  phases_ = {};
  blocks_ = {};
}

void PlaneTrack::truncate_index() {
  if (empty()) {
    blocks_.clear();
    return;
  }
  const std::int64_t last = (pushed_ - 1) / kBlock;
  while (first_block_ + static_cast<std::int64_t>(blocks_.size()) - 1 > last) blocks_.pop_back();
  blocks_.back().clear();
  const std::int64_t oldest_number = pushed_ - static_cast<std::int64_t>(size());
  for (std::int64_t n = std::max(last * kBlock, oldest_number); n < pushed_; ++n) {
    const TimedObservation& observation = (*this)[static_cast<std::size_t>(n - oldest_number)];
    blocks_.back().add(observation.length, observation.iteration);
  }
}

std::size_t PlaneTrack::lower_bound(Iteration k) const {
  if (empty() || newest().iteration < k) return size();
  if (k <= oldest().iteration) return 0;
  // There is at most one observation an iteration, and mostly one in each.
  const auto since = static_cast<std::size_t>(newest().iteration - k) + 1;
  const std::size_t low = size() - std::min(since, size());
  if ((*this)[low].iteration >= k) return low;
  return observations_.partition_point(low, size(),
                                       [k](const Kept& kept) { return kept.observation.iteration < k; });
}

const TimedObservation* PlaneTrack::find(Iteration k) const {
  const std::size_t i = lower_bound(k);
  return i < size() && (*this)[i].iteration == k ? &(*this)[i] : nullptr;
}

Intervals PlaneTrack::visible() const {
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

LargestLengths PlaneTrack::largest(const Interval& interval) const {
  LargestLengths result;
  const std::int64_t oldest_number = pushed_ - static_cast<std::int64_t>(size());
  const std::int64_t end = oldest_number + static_cast<std::int64_t>(lower_bound(interval.last + 1));
  for (std::int64_t n = oldest_number + static_cast<std::int64_t>(lower_bound(interval.first)); n < end;) {
    if (n % kBlock == 0 && n + kBlock <= end) {
      result.add(blocks_[static_cast<std::size_t>(n / kBlock - first_block_)]);
      n += kBlock;
    } else {
      const TimedObservation& observation = (*this)[static_cast<std::size_t>(n - oldest_number)];
      result.add(observation.length, observation.iteration);
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

TrackSize size_in(const PlaneTrack& track, const Interval& interval, const CompareOptions& options) {
  return backed_size(track.largest(interval), options);
}

}  // namespace hallway::slam_plane::thesis
