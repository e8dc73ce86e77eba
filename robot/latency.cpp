// SPDX-License-Identifier: MIT
#include "robot/latency.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hallway::robot {

/// Below 2^kBits a class for each value; above, each power of two is cut into 2^kBits classes.
std::size_t Latency::class_of(std::uint64_t ns) {
  if (ns < (1u << kBits)) return ns;
  const auto power = static_cast<unsigned>(std::bit_width(ns)) - 1;
  const unsigned shift = power - kBits;
  return (std::size_t{shift + 1} << kBits) + ((ns >> shift) & ((1u << kBits) - 1));
}

std::uint64_t Latency::upper_end(std::size_t index) {
  if (index < (1u << kBits)) return index;
  const std::size_t shift = (index >> kBits) - 1;
  const std::uint64_t lower = ((index & ((1u << kBits) - 1)) | (1u << kBits)) << shift;
  return lower + ((std::uint64_t{1} << shift) - 1);
}

void Latency::add(std::chrono::nanoseconds duration) {
  const std::int64_t ns = std::max<std::int64_t>(0, duration.count());
  ++classes_[class_of(static_cast<std::uint64_t>(ns))];
  ++count_;
  worst_ = std::max(worst_, std::chrono::nanoseconds(ns));
}

std::chrono::nanoseconds Latency::quantile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    seen += classes_[i];
    if (seen > 0 && seen >= wanted) {
      return std::min(worst_, std::chrono::nanoseconds(static_cast<std::int64_t>(upper_end(i))));
    }
  }
  return {};
}

}  // namespace hallway::robot
