// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hallway::eval {

/// Which pose of a reference belongs to which of an estimate, by index.
struct Match {
  std::size_t reference = 0;
  std::size_t estimate = 0;

  friend bool operator==(const Match&, const Match&) = default;
};

/// Pairs times one to one: of all pairs that differ by at most `most_s`, the one that differs least comes first (of equal ones
/// the one that is earlier in the reference), and each time is used once. This is what `associate.py` of the TUM RGB-D
/// benchmark does.
///
/// @param reference_s, estimate_s  seconds, each increasing
/// @return in order of time. O(n log n).
std::vector<Match> associate(std::span<const double> reference_s, std::span<const double> estimate_s,
                             double most_s);

}  // namespace hallway::eval
