// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hallway::sense {

/// When a sensor measures, and how late its readings arrive.
struct SensorTiming {
  double rate_hz = 0.0;    ///< readings per second; 0: one for every frame
  double phase_s = 0.0;    ///< time of the first reading, from 0
  double latency_s = 0.0;  ///< from a reading to its arrival, from 0
};

/// The readings of a sensor on the clock of the frames. All times are whole nanoseconds, so that a reading is in the same frame everywhere.
class ReadingClock {
 public:
  /// @param period_ns  from frame to frame, above 0
  ReadingClock(const SensorTiming& timing, std::int64_t period_ns)
      : rate_hz_(timing.rate_hz),
        phase_ns_(std::llround(timing.phase_s * 1e9)),
        latency_ns_(std::llround(timing.latency_s * 1e9)),
        period_ns_(period_ns) {}

  /// The time of reading `k`. Does not decrease with k; what no clock reaches is the end of time.
  std::int64_t time_of(std::uint64_t k) const {
    if (rate_hz_ == 0.0) return phase_ns_ + static_cast<std::int64_t>(k) * period_ns_;
    constexpr double kEnd_ns = 9e18;  // with the longest phase and latency a whole number of 64 bits
    return phase_ns_ + std::llround(std::min(static_cast<double>(k) * 1e9 / rate_hz_, kEnd_ns));
  }
  /// How many readings have arrived by a time: reading k arrives at time_of(k) + latency. O(1).
  std::uint64_t arrived_by(std::int64_t t_ns) const {
    const std::int64_t since_ns = t_ns - latency_ns_ - phase_ns_;
    if (since_ns < 0) return 0;
    const double interval_ns = rate_hz_ == 0.0 ? static_cast<double>(period_ns_) : 1e9 / rate_hz_;
    auto n = static_cast<std::uint64_t>(static_cast<double>(since_ns) / interval_ns);
    while (n > 0 && time_of(n - 1) + latency_ns_ > t_ns) --n;
    while (time_of(n) + latency_ns_ <= t_ns) ++n;
    return n;
  }

 private:
  double rate_hz_;
  std::int64_t phase_ns_, latency_ns_, period_ns_;
};

}  // namespace hallway::sense
