// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "base/random.hpp"

namespace hallway::sense {

/// How a sensor's clock differs from the robot's. The default is the robot's clock.
struct SensorClockSpec {
  double offset_s = 0.0;   ///< of the sensor's clock at the robot's time 0, positive: it is ahead; within 1e9
  double drift_ppm = 0.0;  ///< how much faster the sensor's clock runs, in parts per million; within 1e5
  double jitter_s = 0.0;   ///< standard deviation of each stamp, from 0
};

/// Stamps times with a sensor's clock:
///
///     stamp(k, t) = round(t + offset + 1e-6 drift_ppm t + clamp(jitter_s z_k, -cut, +cut))
///
/// where t is the robot's time and z_k a standard normal deviate keyed by (seed, sensor's name, k). `cut` is the smaller of 4 jitter_s and half of what is
/// between the stamps of readings that are an interval apart, less 1 ns. So stamps of times that are at least an interval apart never decrease with k; and where
/// jitter_s is not small against the interval, the jitter is narrower than declared. An interval of at most 1 ns has no jitter.
///
/// A pure function of its arguments; O(1). Exact to 1e-5 ns before rounding, at all times. Stamps beyond 64 bits are the greatest or least number of
/// nanoseconds. Stamps may be negative where the offset is.
class SensorClock {
 public:
  /// Throws Error{kBadInput} that names sensor and member for a specification out of range.
  /// @param interval_ns  the least time between two stamped readings, from 0
  SensorClock(const std::string& sensor, const SensorClockSpec& spec, std::int64_t interval_ns,
              std::uint64_t seed);

  /// The stamp of a time that belongs to reading `k`. Of one reading's times (begin, end, each ray's) all have the same jitter, so that they keep their
  /// order, and only drift changes what is between them.
  std::int64_t stamp(std::uint64_t k, std::int64_t t_true_ns) const;

 private:
  Random random_;
  std::int64_t offset_ns_;
  std::int64_t drift_whole_;  ///< nanoseconds per second, the whole ones
  double drift_rest_;         ///< and the rest
  double jitter_ns_;          ///< standard deviation
  double cut_ns_;
};

}  // namespace hallway::sense
