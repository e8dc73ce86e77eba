// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::study {

/// Mean; empty for no values.
std::optional<double> mean(std::span<const double> values);

/// The middle value, of an even number the mean of the middle two; empty for no values. O(n log n).
std::optional<double> median(std::vector<double> values);

/// A number with the interval that holds the true one with 95 %.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The 97.5 % point of Student's distribution, to 0.1 %. @param freedom  degrees of freedom, at least 1
double student_975(int freedom);

/// Mean of independent normal values, by Student's distribution; empty for fewer than two.
std::optional<Interval> mean_interval(std::span<const double> values);

/// The share of successes among independent trials, with Wilson's score interval of 95 % (Wilson, "Probable Inference, the Law of Succession, and Statistical
/// Inference", 1927), which is within [0, 1] and not empty for 0 or all. Empty for no trials.
std::optional<Interval> share_interval(std::uint64_t successes, std::uint64_t trials);

/// y = intercept + slope x.
struct LineFit {
  double intercept = 0.0;
  double slope = 0.0;
  double slope_half_width = 0.0;  ///< of the slope's 95 % interval; 0 for two points
};

/// Least squares; empty where there are not two different x.
std::optional<LineFit> fit_line(std::span<const Vec2> points);

/// The exponent of y = a x^b: the slope over logarithms. Points that are not above zero are left out. Empty as for fit_line().
std::optional<LineFit> fit_power(std::span<const Vec2> points);

/// y = sqrt(scale^2 / x + floor^2): an error of independent parts that falls as 1/sqrt(x) to a floor.
struct RootFit {
  double scale = 0.0;
  double floor = 0.0;  ///< 0 where the best floor would be imaginary
};

/// Least squares of relative errors of y^2; empty for fewer than three points above zero.
std::optional<RootFit> fit_root_with_floor(std::span<const Vec2> points);

}  // namespace hallway::study
