// SPDX-License-Identifier: MIT
#include "eval/time_summary.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace hallway::eval {
namespace {

/// The smallest value that at least `percent` of the sorted values do not exceed.
double nearest_rank(const std::vector<double>& sorted, std::size_t percent) {
  const std::size_t rank = (sorted.size() * percent + 99) / 100;
  return sorted[rank - 1];
}

}  // namespace

std::optional<TimeSummary> summarize(std::vector<double> values_ms) {
  if (values_ms.empty()) return std::nullopt;
  std::sort(values_ms.begin(), values_ms.end());
  const double sum = std::accumulate(values_ms.begin(), values_ms.end(), 0.0);
  return TimeSummary{sum / static_cast<double>(values_ms.size()), nearest_rank(values_ms, 50),
                     nearest_rank(values_ms, 99), values_ms.back()};
}

}  // namespace hallway::eval
