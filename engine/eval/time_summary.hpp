// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "eval/metrics.hpp"

namespace hallway::eval {

/// Mean, percentiles by nearest rank, and maximum. Empty for no values. O(n log n).
std::optional<TimeSummary> summarize(std::vector<double> values_ms);

}  // namespace hallway::eval
