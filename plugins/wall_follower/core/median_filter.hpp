// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "wall_follower/core/odometer.hpp"

namespace hallway::wall_follower {

/// The median of the last readings of an infrared detector: one or two false or missed readings among five do not show.
class MedianFilter {
 public:
  static constexpr std::size_t kReadings = 5;

  void clear() { count_ = 0; }
  /// @param range_m  infinite: nothing seen  @param from  where the robot was
  void add(double range_m, const Place& from) {
    ranges_[count_ % kReadings] = range_m;
    places_[count_ % kReadings] = from;
    ++count_;
  }
  /// Whether there are enough readings for a median.
  bool ready() const { return count_ >= kReadings; }
  /// Infinite before there are enough.
  double range_m() const {
    if (!ready()) return std::numeric_limits<double>::infinity();
    std::array<double, kReadings> sorted = ranges_;
    std::nth_element(sorted.begin(), sorted.begin() + kReadings / 2, sorted.end());
    return sorted[kReadings / 2];
  }
  /// Where the robot was at the middle one of the readings.
  const Place& from() const { return places_[(count_ + kReadings / 2) % kReadings]; }

 private:
  std::array<double, kReadings> ranges_{};
  std::array<Place, kReadings> places_{};
  std::size_t count_ = 0;
};

}  // namespace hallway::wall_follower
