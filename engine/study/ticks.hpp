// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hallway::study {

/// A place on an axis that has a number.
struct Tick {
  double value = 0.0;
  std::string text{};  ///< empty for one without a number
};

/// What an axis shows.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

/// A range that holds all values with some room at both ends; with `from_zero` it begins at 0 where that is near. On a logarithmic axis
/// values that are not above zero do not count, and without values it goes from 0.1 to 1; on a linear one from 0 to 1.
AxisRange axis_range(const std::vector<double>& values, bool log);

/// Ticks at multiples of 1, 2 or 5 times a power of ten, at most `most` (at least 2) of them, within the range.
/// @param least_step  the ticks are no nearer to each other
std::vector<Tick> linear_ticks(const AxisRange& range, int most, double least_step = 0.0);

/// Ticks at powers of ten; where there are fewer than three, also at 2 and 5 times these. Within the range, which is above zero.
std::vector<Tick> log_ticks(const AxisRange& range, int most);

}  // namespace hallway::study
