// SPDX-License-Identifier: MIT
#include "eval/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hallway::eval {

std::optional<ErrorStatistics> statistics_of(std::vector<double> errors) {
  if (errors.empty()) return std::nullopt;
  // Of an estimate that is beyond all measure: nothing is known but that it is wrong.
  std::replace_if(
      errors.begin(), errors.end(), [](double error) { return std::isnan(error); },
      std::numeric_limits<double>::infinity());
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const double error : errors) {
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(errors.size());
  const std::size_t middle = errors.size() / 2;
  const double median = errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  return ErrorStatistics{errors.size(), std::sqrt(squares / count), sum / count, median, errors.back()};
}

}  // namespace hallway::eval
