// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/history.hpp"

#include <algorithm>

namespace hallway::slam_point::thesis {
namespace {

bool is_before(const Sighting& sighting, Iteration iteration) {
  return sighting.iteration < iteration;
}

}  // namespace

void History::add(Iteration iteration, const Vec3& point) {
  sightings_.push_back({iteration, point});
}

const Vec3* History::find(Iteration iteration) const {
  const std::span<const Sighting> found = between(iteration, iteration);
  return found.empty() ? nullptr : &found.front().point;
}

std::span<const Sighting> History::between(Iteration first, Iteration last) const {
  const auto begin = sightings_.begin() + static_cast<std::ptrdiff_t>(begin_);
  const auto low = std::lower_bound(begin, sightings_.end(), first, is_before);
  auto high = sightings_.end();
  if (!sightings_.empty() && sightings_.back().iteration > last) {
    high = std::lower_bound(low, sightings_.end(), last + 1, is_before);
  }
  return {low, high};
}

void History::forget_before(Iteration first) {
  while (begin_ < sightings_.size() && sightings_[begin_].iteration < first) ++begin_;
  if (begin_ == sightings_.size()) {
    sightings_ = {};
    begin_ = 0;
  } else if (2 * begin_ > sightings_.size()) {
    sightings_.erase(sightings_.begin(), sightings_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
}

void History::merge(const History& other) {
  std::vector<Sighting> both(sightings_.begin() + static_cast<std::ptrdiff_t>(begin_), sightings_.end());
  both.insert(both.end(), other.sightings_.begin() + static_cast<std::ptrdiff_t>(other.begin_),
              other.sightings_.end());
  const auto earlier = [](const Sighting& a, const Sighting& b) { return a.iteration < b.iteration; };
  const auto same = [](const Sighting& a, const Sighting& b) { return a.iteration == b.iteration; };
  std::stable_sort(both.begin(), both.end(), earlier);
  both.erase(std::unique(both.begin(), both.end(), same), both.end());
  sightings_ = std::move(both);
  begin_ = 0;
}

}  // namespace hallway::slam_point::thesis
