// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "import/imu_table.hpp"

namespace hallway::import {

// A sample of the ABI is a mean over an interval; a row of other programs' tables is a value at a time. That time is the middle of the interval.

/// From when to when a sample was measured.
struct Interval {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;

  bool operator==(const Interval&) const = default;
};

/// The time that a table has for a sample of that interval, to the nanosecond below.
constexpr std::int64_t middle_ns(const Interval& interval) {
  return interval.begin_ns + (interval.end_ns - interval.begin_ns) / 2;
}

/// The intervals of the samples of a table: they meet midway between two samples, but none goes farther from its time than half of the median gap. So
/// equal intervals without gaps, written by middle_ns(), are read back as they were. None begins below 0. O(n log n).
/// @param samples  times increase
std::vector<Interval> intervals_of(std::span<const ImuSample> samples);

}  // namespace hallway::import
