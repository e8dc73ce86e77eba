// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::csg {

/// Gives points numbers, the same to points that are nearly the same.
class Welder {
 public:
  explicit Welder(double distance) : distance_(distance), cell_(64.0 * distance) {}

  /// The number of the first point within the distance (along each axis), else a new one. O(1) on average.
  std::uint32_t number_of(const Vec3& point);
  const std::vector<Vec3>& points() const { return points_; }

 private:
  double distance_;
  double cell_;
  std::vector<Vec3> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace hallway::csg
