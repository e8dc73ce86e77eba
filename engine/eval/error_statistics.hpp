// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace hallway::eval {

/// What a list of errors (not negative) comes to, in their unit.
struct ErrorStatistics {
  std::uint64_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< of an even number the mean of the middle two
  double max = 0.0;
};

/// Empty for no errors. O(n log n).
std::optional<ErrorStatistics> statistics_of(std::vector<double> errors);

}  // namespace hallway::eval
