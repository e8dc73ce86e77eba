// SPDX-License-Identifier: MIT
#include "import/imu_interval.hpp"

#include <algorithm>

namespace hallway::import {
namespace {

std::int64_t median_gap_ns(std::span<const ImuSample> samples) {
  if (samples.size() < 2) return 0;
  std::vector<std::int64_t> gaps;
  gaps.reserve(samples.size() - 1);
  for (std::size_t i = 1; i < samples.size(); ++i) gaps.push_back(samples[i].t_ns - samples[i - 1].t_ns);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::ranges::nth_element(gaps, middle);
  return *middle;
}

}  // namespace

std::vector<Interval> intervals_of(std::span<const ImuSample> samples) {
  const std::int64_t usual_ns = median_gap_ns(samples);
  std::vector<Interval> intervals;
  intervals.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::int64_t t = samples[i].t_ns;
    const std::int64_t before = i == 0 ? usual_ns : std::min(usual_ns, t - samples[i - 1].t_ns);
    const std::int64_t after =
        i + 1 == samples.size() ? usual_ns : std::min(usual_ns, samples[i + 1].t_ns - t);
    // middle_ns() rounds down: of an odd interval the larger part is behind the middle.
    intervals.push_back({std::max<std::int64_t>(0, t - before / 2), t + after - after / 2});
  }
  return intervals;
}

}  // namespace hallway::import
