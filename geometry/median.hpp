// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway {

/// The middle value of at least one, of an even number the upper one of the two in the middle. Reorders the values. O(n).
template <typename Value, typename Before = std::less<>>
const Value& median(std::vector<Value>& values, Before before = {}) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end(), before);
  return *middle;
}

/// The median of each coordinate of at least one point: unlike a mean or the middle of a box, far outliers do not move it. O(n).
inline Vec3 median_of_coordinates(std::span<const Vec3> points) {
  Vec3 middle;
  std::vector<double> values(points.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [axis](const Vec3& p) { return p[axis]; });
    middle[axis] = median(values);
  }
  return middle;
}

}  // namespace hallway
