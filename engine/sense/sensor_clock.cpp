// SPDX-License-Identifier: MIT
#include "sense/sensor_clock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr double kLargestOffset_s = 1e9;
constexpr double kLargestDrift_ppm = 1e5;
constexpr double kLargestJitter_s = 1e9;

const SensorClockSpec& checked_clock(const std::string& sensor, const SensorClockSpec& spec,
                                     std::int64_t interval_ns) {
  const SpecCheck check(sensor);
  check.within("offset_s", spec.offset_s, -kLargestOffset_s, kLargestOffset_s);
  check.within("drift_ppm", spec.drift_ppm, -kLargestDrift_ppm, kLargestDrift_ppm);
  check.within("jitter_s", spec.jitter_s, 0.0, kLargestJitter_s);
  if (interval_ns < 0) check.fail("interval", "is below 0 ns");
  return spec;
}

std::int64_t sum_in_range(std::int64_t a, std::int64_t b) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  if (b > 0 && a > kMost - b) return kMost;
  if (b < 0 && a < kLeast - b) return kLeast;
  return a + b;
}

}  // namespace

SensorClock::SensorClock(const std::string& sensor, const SensorClockSpec& spec, std::int64_t interval_ns,
                         std::uint64_t seed)
    : random_(seed, stream_id("sensor.clock." + sensor)),
      offset_ns_(std::llround(1e9 * checked_clock(sensor, spec, interval_ns).offset_s)),
      drift_whole_(std::llround(1e3 * spec.drift_ppm)),
      drift_rest_(1e3 * spec.drift_ppm - static_cast<double>(drift_whole_)),
      jitter_ns_(1e9 * spec.jitter_s) {
  // What is between two true times shrinks by a negative drift; 1 ns is left for rounding.
  const double between_ns =
      static_cast<double>(interval_ns) * (1.0 + std::min(1e-6 * spec.drift_ppm, 0.0)) - 1.0;
  cut_ns_ = std::clamp(0.5 * between_ns, 0.0, 4.0 * jitter_ns_);
}

std::int64_t SensorClock::stamp(std::uint64_t k, std::int64_t t_true_ns) const {
  // Whole seconds by whole numbers: a product of doubles would be off by nanoseconds late in a run.
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t seconds = t_true_ns / kSecond_ns;
  const double rest_s = 1e-9 * static_cast<double>(t_true_ns % kSecond_ns);
  double difference_ns =
      drift_rest_ * static_cast<double>(seconds) + (static_cast<double>(drift_whole_) + drift_rest_) * rest_s;
  if (cut_ns_ > 0.0) difference_ns += std::clamp(jitter_ns_ * random_.normal(0, k), -cut_ns_, cut_ns_);
  // Rounds half up: the sign of the difference may not matter to the order of stamps.
  const auto rounded_ns = static_cast<std::int64_t>(std::floor(difference_ns + 0.5));
  return sum_in_range(sum_in_range(t_true_ns, drift_whole_ * seconds + rounded_ns), offset_ns_);
}

}  // namespace hallway::sense
