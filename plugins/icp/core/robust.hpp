// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace hallway::icp {

/// What residuals count. `scale` is 1.4826 times the median residual of a step, so that the constants below are those of unit normal
/// deviates (95 % efficiency).
enum class Kernel {
  none,    ///< all the same: least squares
  huber,   ///< 1 up to 1.345 scale, then falling as 1 / residual
  cauchy,  ///< 1 / (1 + (residual / 2.385 scale)^2)
  tukey    ///< (1 - (residual / 4.685 scale)^2)^2, 0 from there on: what lies far off counts nothing
};

/// 1.4826 times the median of residuals that are not negative; 0 for none of them. O(n).
double scale_of(std::vector<double> residuals);

/// The weight of a residual in [0, 1]. With `scale` 0, residuals of 0 count 1 and others 0 (huber and cauchy: the limit).
double weight_of(Kernel kernel, double residual, double scale);

}  // namespace hallway::icp
