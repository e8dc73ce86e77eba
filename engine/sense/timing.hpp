// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sense/sensor_clock.hpp"

namespace hallway::sense {

/// When a sensor measures, how late its readings arrive, and what its clock says.
struct SensorTiming {
  double rate_hz = 0.0;     ///< readings per second; 0: one for every frame
  double phase_s = 0.0;     ///< time of the first reading, from 0
  double latency_s = 0.0;   ///< from the end of a reading to its arrival, from 0
  SensorClockSpec clock{};  ///< that stamps its readings
};

/// The end of time, for what no clock reaches: with the longest phase and latency a whole number of 64 bits.
inline constexpr double kEndOfTime_ns = 9e18;

/// From one reading to the next, rounded; whole nanoseconds.
/// @param period_ns  from frame to frame
inline std::int64_t interval_ns(const SensorTiming& timing, std::int64_t period_ns) {
  if (timing.rate_hz == 0.0) return period_ns;
  return std::llround(std::min(1e9 / timing.rate_hz, kEndOfTime_ns));
}

/// What time a reading takes.
struct ReadingSpan {
  std::int64_t duration_ns = 0;  ///< from 0
  bool to_next = false;          ///< until the next reading begins, whatever the duration
};

/// The readings of a sensor on the clock of the frames. All times are whole nanoseconds, so that a reading is in the same frame everywhere.
class ReadingClock {
 public:
  /// @param period_ns  from frame to frame, above 0
  ReadingClock(const SensorTiming& timing, std::int64_t period_ns, const ReadingSpan& span = {})
      : rate_hz_(timing.rate_hz),
        phase_ns_(std::llround(timing.phase_s * 1e9)),
        latency_ns_(std::llround(timing.latency_s * 1e9)),
        period_ns_(period_ns),
        span_(span) {}

  /// When reading `k` begins. Does not decrease with k; what no clock reaches is the end of time.
  std::int64_t time_of(std::uint64_t k) const {
    if (rate_hz_ == 0.0) return phase_ns_ + static_cast<std::int64_t>(k) * period_ns_;
    return phase_ns_ + std::llround(std::min(static_cast<double>(k) * 1e9 / rate_hz_, kEndOfTime_ns));
  }
  /// When it ends.
  std::int64_t end_of(std::uint64_t k) const {
    if (span_.to_next) return time_of(k + 1);
    const std::int64_t begin_ns = time_of(k);
    constexpr auto kEnd_ns = static_cast<std::int64_t>(kEndOfTime_ns);
    return span_.duration_ns > kEnd_ns - begin_ns ? std::max(begin_ns, kEnd_ns)
                                                  : begin_ns + span_.duration_ns;
  }
  /// How many readings have arrived by a time: reading k arrives at end_of(k) + latency. O(1).
  std::uint64_t arrived_by(std::int64_t t_ns) const {
    const std::int64_t since_ns = t_ns - latency_ns_ - phase_ns_;
    if (since_ns < 0) return 0;
    const double interval_ns = rate_hz_ == 0.0 ? static_cast<double>(period_ns_) : 1e9 / rate_hz_;
    auto n = static_cast<std::uint64_t>(static_cast<double>(since_ns) / interval_ns);
    while (n > 0 && end_of(n - 1) + latency_ns_ > t_ns) --n;
    while (end_of(n) + latency_ns_ <= t_ns) ++n;
    return n;
  }

 private:
  double rate_hz_;
  std::int64_t phase_ns_, latency_ns_, period_ns_;
  ReadingSpan span_;
};

}  // namespace hallway::sense
